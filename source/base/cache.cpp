#include "base/cache.h"

#include "base/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

/// First bytes of an entry; key and payload follow. In the byte order of the machine: elsewhere the magic
/// differs and the entry counts as damaged.
struct Header {
    uint64_t magic = 0x31454843'41434C53ull;
    uint32_t version = 1;
    uint32_t key_bytes = 0;
    uint64_t payload_bytes = 0;
    uint64_t payload_hash = 0;
};
static_assert(sizeof(Header) == 32);

constexpr std::string_view entry_suffix = ".entry", unfinished_suffix = ".part";

/// The payload of an open entry; nothing when any part of it is not as it was written.
std::optional<std::vector<std::byte>> checked_payload(std::ifstream& file, std::string_view key,
                                                      uint64_t limit) {
    const auto file_bytes = static_cast<uint64_t>(file.seekg(0, std::ios::end).tellg());  // -1 when it fails
    if (file_bytes > limit || !file.seekg(0)) return std::nullopt;
    Header header;
    const Header expected;
    if (!file.read(reinterpret_cast<char*>(&header), sizeof(header))) return std::nullopt;
    // Sizes first: a damaged one must not become an allocation.
    if (header.magic != expected.magic || header.version != expected.version ||
        header.key_bytes != key.size() || file_bytes < sizeof(header) + key.size() ||
        header.payload_bytes != file_bytes - sizeof(header) - key.size())
        return std::nullopt;
    std::string stored(key.size(), '\0');
    if (!file.read(stored.data(), static_cast<std::streamsize>(stored.size())) || stored != key)
        return std::nullopt;
    std::vector<std::byte> payload(header.payload_bytes);
    if (!file.read(reinterpret_cast<char*>(payload.data()), static_cast<std::streamsize>(payload.size())))
        return std::nullopt;
    if (Hash().add(payload.data(), payload.size()).value() != header.payload_hash) return std::nullopt;
    return payload;
}

bool write_entry(const fs::path& path, std::string_view key, std::span<const std::byte> payload) {
    Header header;
    header.key_bytes = static_cast<uint32_t>(key.size());
    header.payload_bytes = payload.size();
    header.payload_hash = Hash().add(payload.data(), payload.size()).value();
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(&header), sizeof(header));
    file.write(key.data(), static_cast<std::streamsize>(key.size()));
    file.write(reinterpret_cast<const char*>(payload.data()), static_cast<std::streamsize>(payload.size()));
    file.close();
    return file.good();
}

void drop(const fs::path& path) {
    std::error_code ignored;
    fs::remove(path, ignored);
}

/// A name that no other thread or process uses.
fs::path unfinished_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    return target.string() + fmt::format(".{}-{}{}", ::getpid(), counter++, unfinished_suffix);
}

std::atomic<bool> enabled{true};

const Cache& program_cache() {
    // Never destroyed: devices that close at the program's end still write to it.
    static const Cache* const cache = new Cache(default_cache_folder());
    return *cache;
}

}  // namespace

Cache::Cache(fs::path folder, uint64_t limit_bytes) : folder_(std::move(folder)), limit_(limit_bytes) {}

fs::path Cache::file_of(std::string_view key) const {
    const uint64_t low = Hash().add(key.data(), key.size()).value();
    const uint64_t high = Hash().add_number(1).add(key.data(), key.size()).value();
    return folder_ / fmt::format("{:016x}{:016x}{}", high, low, entry_suffix);
}

std::optional<std::vector<std::byte>> Cache::read(std::string_view key) const {
    if (folder_.empty()) return std::nullopt;
    const fs::path path = file_of(key);
    std::error_code error;
    // Anything but a plain file is not ours to open: a pipe would wait for ever.
    if (fs::status(path, error).type() != fs::file_type::regular) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    auto payload = checked_payload(file, key, limit_);
    file.close();
    if (payload)
        fs::last_write_time(path, fs::file_time_type::clock::now(),
                            error);  // used now: the last to be evicted
    else
        drop(path);
    return payload;
}

void Cache::write(std::string_view key, std::span<const std::byte> payload) const {
    if (folder_.empty() || sizeof(Header) + key.size() + payload.size() > limit_) return;
    std::error_code error;
    if (fs::create_directories(folder_, error)) fs::permissions(folder_, fs::perms::owner_all, error);
    const fs::path target = file_of(key), unfinished = unfinished_name(target);
    if (write_entry(unfinished, key, payload)) {
        fs::rename(unfinished, target, error);
        if (!error) return evict();
    }
    drop(unfinished);
}

void Cache::evict() const {
    struct Entry {
        fs::path path;
        uint64_t bytes;
        fs::file_time_type time;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        // Other processes add and remove files meanwhile: whatever cannot be asked is passed over.
        std::error_code gone;
        if (!fs::is_regular_file(it->symlink_status(gone))) continue;
        Entry entry{it->path(), it->file_size(gone), {}};
        if (gone) continue;
        entry.time = it->last_write_time(gone);
        if (gone) continue;
        if (entry.path.extension() == unfinished_suffix && now - entry.time > std::chrono::hours(1))
            drop(entry.path);  // left by a process that was killed
        if (entry.path.extension() != entry_suffix) continue;
        total += entry.bytes;
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (size_t i = 0; i < entries.size() && total > limit_; ++i) {
        drop(entries[i].path);
        total -= entries[i].bytes;
    }
}

fs::path default_cache_folder() {
    const auto absolute = [](const char* name) {
        const char* value = std::getenv(name);
        const fs::path path = value ? value : "";
        return path.is_absolute() ? path : fs::path();
    };
    // The XDG base directory specification: a relative path is to be ignored.
    if (const fs::path cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "strandlab";
    if (const fs::path home = absolute("HOME"); !home.empty()) return home / ".cache" / "strandlab";
    return {};
}

void set_cache_enabled(bool value) { enabled.store(value, std::memory_order_relaxed); }

std::optional<std::vector<std::byte>> cache_read(std::string_view key) {
    if (!enabled.load(std::memory_order_relaxed)) return std::nullopt;
    return program_cache().read(key);
}

void cache_write(std::string_view key, std::span<const std::byte> payload) {
    if (enabled.load(std::memory_order_relaxed)) program_cache().write(key, payload);
}

}  // namespace strandlab
