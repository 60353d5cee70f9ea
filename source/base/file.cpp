#include "base/file.h"

#include "base/byte_source.h"
#include "base/error.h"

#include <climits>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace strandlab {
namespace {

[[noreturn]] void fail_at(const std::string& path, const char* action, int error) {
    fail(ExitCode::bad_input, "{}: cannot {}: {}", path, action, std::generic_category().message(error));
}

/// Writes everything or returns the error number.
int write_all(int descriptor, const char* data, size_t bytes) {
    while (bytes > 0) {
        const ssize_t wrote = ::write(descriptor, data, bytes);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) return errno;
        data += wrote;
        bytes -= static_cast<size_t>(wrote);
    }
    return 0;
}

/// The file behind symbolic links; the path itself where there is none yet.
std::string resolved(const std::string& path) {
    char* real = ::realpath(path.c_str(), nullptr);
    if (!real) return path;
    std::string target = real;
    std::free(real);
    return target;
}

std::string folder_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Makes the rename durable. Some file systems cannot sync a folder; the file is complete all the same.
void sync_folder(const std::string& path) {
    const int folder = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    ::fsync(folder);
    ::close(folder);
}

struct Descriptor {
    int value;
    ~Descriptor() { ::close(value); }
};

}  // namespace

std::string read_file(const std::string& path) {
    const ByteSource source = ByteSource::from_file(path);
    std::string bytes(source.size(), '\0');
    source.read(0, bytes.data(), bytes.size(), "contents");
    return bytes;
}

FileWriter::FileWriter(const std::string& path) : path_(path), target_(resolved(path)) {
    struct stat status;
    const bool exists = ::stat(target_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail_to_write(EISDIR);
    if (exists && ::access(target_.c_str(), W_OK) != 0) fail_to_write(errno);
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail_to_write(errno);
        return;
    }
    static std::atomic<unsigned> counter{0};
    do {  // a name that another process holds is passed over
        temporary_ = fmt::format("{}.{}-{}.part", target_, ::getpid(), counter++);
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) {
        const int error = errno;
        temporary_.clear();
        fail_to_write(error);
    }
    if (exists) (void)::fchmod(descriptor_, status.st_mode & 07777);
}

FileWriter::~FileWriter() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileWriter::fail_to_write(int error) const { fail_at(path_, "write", error); }

void FileWriter::write(const void* data, size_t bytes) {
    if (const int error = write_all(descriptor_, static_cast<const char*>(data), bytes)) fail_to_write(error);
}

void FileWriter::commit() {
    if (!temporary_.empty() && ::fsync(descriptor_) != 0) fail_to_write(errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail_to_write(errno);
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail_to_write(errno);
    temporary_.clear();
    sync_folder(target_);
}

void write_file(const std::string& path, std::string_view bytes) {
    FileWriter file(path);
    file.write(bytes);
    file.commit();
}

void check_appendable(const std::string& path) {
    struct stat status;
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail_at(path, "append", EISDIR);
    if (::access(exists ? path.c_str() : folder_of(path).c_str(), W_OK) != 0) fail_at(path, "append", errno);
}

bool drop_torn_line(const std::string& path, const std::function<bool(std::string_view line)>& is_whole) {
    const Descriptor file{::open(path.c_str(), O_RDWR | O_CLOEXEC)};
    if (file.value < 0) {
        if (errno == ENOENT) return false;
        fail_at(path, "open", errno);
    }
    while (::flock(file.value, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status;
    if (::fstat(file.value, &status) != 0) fail_at(path, "read", errno);
    if (!S_ISREG(status.st_mode) || status.st_size == 0) return false;
    // Backwards, block by block, to the newline before the last line.
    std::string line;
    off_t begin = status.st_size;
    while (begin > 0) {
        char block[4096];
        const auto bytes = static_cast<size_t>(std::min<off_t>(begin, sizeof block));
        if (::pread(file.value, block, bytes, begin - static_cast<off_t>(bytes)) !=
            static_cast<ssize_t>(bytes))
            fail_at(path, "read", errno);
        const size_t newline = std::string_view(block, bytes).rfind('\n');
        const size_t kept = newline == std::string_view::npos ? 0 : newline + 1;
        line.insert(0, block + kept, bytes - kept);
        begin -= static_cast<off_t>(bytes - kept);
        if (kept > 0) break;
    }
    if (line.empty() || is_whole(line)) return false;
    if (::ftruncate(file.value, begin) != 0) fail_at(path, "repair", errno);
    return true;
}

void append_line(const std::string& path, std::string_view line, std::string_view first_line) {
    const Descriptor file{::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666)};
    if (file.value < 0) fail_at(path, "append", errno);
    while (::flock(file.value, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status;
    if (::fstat(file.value, &status) != 0) fail_at(path, "append", errno);
    const bool regular = S_ISREG(status.st_mode);
    char last = '\n';
    if (regular && status.st_size > 0 && ::pread(file.value, &last, 1, status.st_size - 1) != 1)
        fail_at(path, "append", errno);

    std::string text(last == '\n' ? "" : "\n");
    if (regular && status.st_size == 0 && !first_line.empty()) text.append(first_line).append("\n");
    text.append(line).append("\n");
    if (const int error = write_all(file.value, text.data(), text.size())) {
        if (regular && ::ftruncate(file.value, status.st_size) != 0)
            fail_at(path, "append or restore", error);
        fail_at(path, "append", error);
    }
}

}  // namespace strandlab
