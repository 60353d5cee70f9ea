#include "base/byte_source.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace strandlab {
namespace {

constexpr size_t block_bytes = size_t(4) << 20;
constexpr size_t pipe_limit = size_t(1) << 30;

[[noreturn]] void fail_to_read(const std::string& path, int error) {
    fail(ExitCode::bad_input, "{}: cannot read: {}", path, std::generic_category().message(error));
}

std::vector<std::byte> read_pipe(const std::string& path, int descriptor) {
    std::vector<std::byte> bytes;
    for (size_t used = 0;;) {
        if (used == pipe_limit)
            fail(ExitCode::bad_input,
                 "{}: not a regular file and longer than {} bytes: save it to a file first", path,
                 pipe_limit);
        bytes.resize(std::min(pipe_limit, std::max(2 * used, size_t(65536))));
        const ssize_t got = ::read(descriptor, bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail_to_read(path, errno);
        used += static_cast<size_t>(got);
        if (got > 0) continue;
        bytes.resize(used);
        return bytes;
    }
}

}  // namespace

ByteSource ByteSource::from_file(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) fail_to_read(path, errno);
    ByteSource source;
    source.name_ = path;
    source.descriptor_ = std::shared_ptr<const int>(new int(descriptor), [](const int* d) {
        ::close(*d);
        delete d;
    });
    struct stat status;
    if (::fstat(descriptor, &status) != 0) fail_to_read(path, errno);
    if (S_ISDIR(status.st_mode)) fail_to_read(path, EISDIR);
    source.size_ = static_cast<uint64_t>(status.st_size);
    if (!S_ISREG(status.st_mode)) {
        source.own_ = std::make_shared<const std::vector<std::byte>>(read_pipe(path, descriptor));
        source.memory_ = source.own_->data();
        source.size_ = source.own_->size();
        source.descriptor_.reset();
    }
    return source;
}

ByteSource ByteSource::from_memory(std::string name, std::span<const std::byte> bytes) {
    ByteSource source;
    source.name_ = std::move(name);
    source.memory_ = bytes.data();
    source.size_ = bytes.size();
    return source;
}

void ByteSource::require(uint64_t offset, uint64_t count, uint64_t item_bytes, std::string_view what) const {
    const uint64_t room = offset <= size_ ? size_ - offset : 0;
    if (offset <= size_ && count <= room / item_bytes) return;
    fail(ExitCode::bad_input,
         "{}: {}: {} x {} bytes at offset {} do not fit into the file's {} bytes: it is truncated or damaged",
         name_, what, count, item_bytes, offset, size_);
}

void ByteSource::read(uint64_t offset, void* to, size_t bytes, std::string_view what) const {
    require(offset, bytes, 1, what);
    if (bytes == 0) return;
    parallel_for((bytes + block_bytes - 1) / block_bytes, [&](size_t block) {
        const size_t begin = block * block_bytes;
        read_some(offset + begin, static_cast<std::byte*>(to) + begin, std::min(block_bytes, bytes - begin));
    });
}

void ByteSource::read_some(uint64_t offset, void* to, size_t bytes) const {
    if (!descriptor_) {
        std::memcpy(to, memory_ + offset, bytes);
        return;
    }
    auto* p = static_cast<std::byte*>(to);
    while (bytes > 0) {
        const ssize_t got = ::pread(*descriptor_, p, bytes, static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail_to_read(name_, errno);
        if (got == 0)
            fail(ExitCode::bad_input, "{}: became shorter while it was read (at offset {})", name_, offset);
        p += got;
        offset += static_cast<uint64_t>(got);
        bytes -= static_cast<size_t>(got);
    }
}

}  // namespace strandlab
