// Results that are costly to recompute, kept in files named after what they were computed from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace strandlab {

/// A folder of entries. A key is any text that names everything the payload depends on, with the version
/// of the algorithm: "oracle/2 surface=... rays=...". It is stored in the entry and compared, so that keys
/// cannot collide. Entries are whole or absent and checked when read: one that is damaged, truncated or
/// of another version is removed and counts as absent. A folder that cannot be read or written is the
/// same as an empty one. Safe for many threads and processes.
class Cache {
  public:
    static constexpr uint64_t default_limit = uint64_t(1) << 30;

    /// An empty folder path: nothing is ever kept.
    explicit Cache(std::filesystem::path folder, uint64_t limit_bytes = default_limit);

    std::optional<std::vector<std::byte>> read(std::string_view key) const;

    /// Keeps a payload, then removes entries that were not used for longest until all fit into the
    /// limit. A payload larger than the limit is not kept.
    void write(std::string_view key, std::span<const std::byte> payload) const;

    /// File of a key, whether it exists or not.
    std::filesystem::path file_of(std::string_view key) const;

  private:
    void evict() const;

    std::filesystem::path folder_;
    uint64_t limit_;
};

/// $XDG_CACHE_HOME/strandlab, else $HOME/.cache/strandlab; empty when neither is an absolute path.
std::filesystem::path default_cache_folder();

/// --no-cache: from now on cache_read finds nothing and cache_write keeps nothing.
void set_cache_enabled(bool enabled);

/// The program's cache in default_cache_folder().
std::optional<std::vector<std::byte>> cache_read(std::string_view key);
void cache_write(std::string_view key, std::span<const std::byte> payload);

}  // namespace strandlab
