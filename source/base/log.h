// Lines for people on standard error. Results go to standard output and never through here.
#pragma once

#include <fmt/core.h>

#include <string_view>

namespace strandlab {

/// --quiet: no information lines and no progress bar. Warnings are always written.
void set_quiet(bool quiet);
bool is_quiet();

namespace log_detail {
void write(std::string_view kind, std::string_view message);
}

/// "strandlab: MESSAGE".
template <class... Args>
void inform(fmt::format_string<Args...> format, Args&&... args) {
    if (!is_quiet()) log_detail::write("", fmt::format(format, std::forward<Args>(args)...));
}

/// "strandlab: warning: MESSAGE": the result stands, but not quite as asked for.
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
    log_detail::write("warning: ", fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace strandlab
