#include "base/file.h"

#include "base/error.h"

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace strandlab {

void append_line(const std::string& path, std::string_view line) {
    const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0)
        fail(ExitCode::bad_input, "{}: cannot append: {}", path, std::generic_category().message(errno));
    const std::string text = std::string(line) + "\n";
    const ssize_t wrote = ::write(file, text.data(), text.size());
    const int error = errno;
    ::close(file);
    if (wrote < 0)
        fail(ExitCode::bad_input, "{}: cannot append: {}", path, std::generic_category().message(error));
    if (static_cast<size_t>(wrote) != text.size())
        fail(ExitCode::bad_input, "{}: cannot append: only a part was written; is the disk full?", path);
}

}  // namespace strandlab
