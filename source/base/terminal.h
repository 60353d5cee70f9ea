// What the terminal can show, and the one line of standard error that is redrawn in place.
#pragma once

#include <string_view>

namespace strandlab {

/// Whether a file descriptor is a terminal that understands cursor movement (TERM is not "dumb").
bool is_terminal(int descriptor);

/// Whether text may be coloured or bold: a terminal, and NO_COLOR is unset or empty (no-color.org).
bool may_colour(int descriptor);

/// Columns of the terminal (COLUMNS where the system does not say); `otherwise` when it is none.
int terminal_width(int descriptor, int otherwise);

/// Shows a text of one line on standard error in place of the last one; empty: removes it. Callers see to
/// it that standard error is a terminal. Safe to call from many threads.
void show_status(std::string_view text);

/// Writes a whole line (the newline is added) to standard error, above the status line if one is shown.
/// Safe to call from many threads.
void write_message(std::string_view line);

}  // namespace strandlab
