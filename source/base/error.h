// The one exception of the program: something outside it is wrong (a file, an option, a device).
// Bugs are asserts, expected outcomes (a miss, an unsupported device) are return values.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

namespace strandlab {

/// Exit status of the program; the numbers are part of its interface.
enum class ExitCode {
    ok = 0,
    threshold = 1,    // a documented tolerance was exceeded
    usage = 2,        // an option is wrong
    no_device = 3,    // no device, or none with the feature asked for
    device_lost = 4,  // device lost or out of memory
    bad_input = 5,    // a file cannot be read, is damaged, or cannot be written
};

/// What is wrong, in one line that names the file, offset or option, the value, and what to do.
struct Error : std::runtime_error {
    Error(ExitCode exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
    ExitCode code;
};

/// Throws an Error with a formatted message: fail(ExitCode::bad_input, "{}: {} strands", path, n).
template <class... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> format, Args&&... args) {
    throw Error(code, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace strandlab
