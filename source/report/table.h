// Aligned plain-text tables for terminals and log files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// A column: its heading, the unit of its numbers (written below the heading), and whether it holds text
/// (aligned left) rather than numbers (aligned right).
struct Column {
    std::string heading;
    std::string unit = {};
    bool text = false;
};

/// How a table is written.
struct TableStyle {
    int width = 0;      // columns that there are; 0: no limit
    bool bold = false;  // headings in bold, with terminal codes
};

/// A table whose columns are as wide as their contents. Where it is wider than the terminal it is written
/// in blocks below each other, each of which begins with the key columns.
class Table {
  public:
    /// key_columns: how many of the first columns tell rows apart.
    explicit Table(std::vector<Column> columns, size_t key_columns = 1);

    /// Adds a row; missing cells at its end are empty. Asserts that there are not too many.
    void add_row(std::vector<std::string> cells);

    bool is_empty() const { return rows_.empty(); }
    /// Lines that end in a newline, without trailing spaces.
    std::string to_string(const TableStyle& style = {}) const;

  private:
    std::vector<std::vector<size_t>> blocks(const std::vector<size_t>& widths, const TableStyle& style) const;

    std::vector<Column> columns_;
    size_t key_columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Style for standard output: its width and colours where it is a terminal (NO_COLOR is respected), plain
/// and unlimited elsewhere.
TableStyle standard_output_style();

/// Columns that a UTF-8 text takes, one for each code point.
size_t display_width(std::string_view text);

}  // namespace strandlab
