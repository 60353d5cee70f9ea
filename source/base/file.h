// Files grown by one line.
#pragma once

#include <string>
#include <string_view>

namespace strandlab {

/// Appends one line (the newline is added) with a single write, so that rows of several processes never
/// mix. Creates the file when missing. Throws Error (bad_input) with path and reason.
void append_line(const std::string& path, std::string_view line);

}  // namespace strandlab
