#include "base/terminal.h"

#include "base/text.h"

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>

namespace strandlab {
namespace {

std::string_view environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? std::string_view(value) : std::string_view();
}

std::mutex status_mutex;
std::string status;  // what is shown now

constexpr std::string_view erase_line = "\r\x1b[K";

/// One write, so that lines of several threads and processes do not mix.
void write_error(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

}  // namespace

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1 && environment("TERM") != "dumb"; }

bool may_colour(int descriptor) { return is_terminal(descriptor) && environment("NO_COLOR").empty(); }

int terminal_width(int descriptor, int otherwise) {
    winsize size{};
    if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    if (!is_terminal(descriptor)) return otherwise;
    const auto columns = to_number(environment("COLUMNS"));
    return columns && *columns >= 1 && *columns <= 10000 ? static_cast<int>(*columns) : otherwise;
}

void show_status(std::string_view text) {
    const std::lock_guard lock(status_mutex);
    if (text == status) return;
    status = text;
    write_error(std::string(erase_line) + status);
}

void write_message(std::string_view line) {
    const std::lock_guard lock(status_mutex);
    std::string text;
    if (!status.empty()) text.append(erase_line);
    text.append(line).append("\n").append(status);
    write_error(text);
}

}  // namespace strandlab
