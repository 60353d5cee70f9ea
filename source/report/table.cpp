#include "report/table.h"

#include "base/terminal.h"

#include <algorithm>
#include <cassert>
#include <unistd.h>
#include <utility>

namespace strandlab {
namespace {

constexpr size_t gap = 2;

/// A line that is put together cell by cell; spaces are written only before something visible.
class Line {
  public:
    void add(std::string_view cell, size_t width, bool left) {
        const size_t padding = width - display_width(cell);
        if (!left) spaces_ += padding;
        if (!cell.empty()) text_.append(std::exchange(spaces_, 0), ' ').append(cell);
        spaces_ += gap + (left ? padding : 0);
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    size_t spaces_ = 0;
};

}  // namespace

size_t display_width(std::string_view text) {
    // Every byte but the continuation bytes of UTF-8 begins a code point.
    return static_cast<size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

Table::Table(std::vector<Column> columns, size_t key_columns)
    : columns_(std::move(columns)), key_columns_(std::min(key_columns, columns_.size())) {}

void Table::add_row(std::vector<std::string> cells) {
    assert(cells.size() <= columns_.size());
    cells.resize(columns_.size());
    rows_.push_back(std::move(cells));
}

/// The columns of each block: the key columns, then as many of the others as fit, at least one.
std::vector<std::vector<size_t>> Table::blocks(const std::vector<size_t>& widths,
                                               const TableStyle& style) const {
    std::vector<size_t> keys;
    size_t key_width = 0;
    for (size_t i = 0; i < key_columns_; ++i) {
        keys.push_back(i);
        key_width += widths[i] + gap;
    }
    std::vector<std::vector<size_t>> result{keys};
    size_t used = key_width;
    for (size_t i = key_columns_; i < columns_.size(); ++i) {
        const bool full = style.width > 0 && used + widths[i] > static_cast<size_t>(style.width);
        if (full && result.back().size() > keys.size()) {
            result.push_back(keys);
            used = key_width;
        }
        result.back().push_back(i);
        used += widths[i] + gap;
    }
    return result;
}

std::string Table::to_string(const TableStyle& style) const {
    std::vector<size_t> widths;
    bool has_units = false;
    for (size_t i = 0; i < columns_.size(); ++i) {
        size_t width = std::max(display_width(columns_[i].heading), display_width(columns_[i].unit));
        for (const auto& row : rows_) width = std::max(width, display_width(row[i]));
        widths.push_back(width);
        has_units |= !columns_[i].unit.empty();
    }
    std::string text;
    for (const std::vector<size_t>& block : blocks(widths, style)) {
        const auto write = [&](auto&& cell_of, bool bold) {
            Line line;
            for (const size_t i : block) line.add(cell_of(i), widths[i], columns_[i].text);
            if (bold) text += "\x1b[1m";
            text += line.text();
            text += bold ? "\x1b[0m\n" : "\n";
        };
        if (!text.empty()) text += "\n";
        write([&](size_t i) -> const std::string& { return columns_[i].heading; }, style.bold);
        if (has_units) write([&](size_t i) -> const std::string& { return columns_[i].unit; }, false);
        write([&](size_t i) { return std::string(widths[i], '-'); }, false);
        for (const auto& row : rows_) write([&](size_t i) -> const std::string& { return row[i]; }, false);
    }
    return text;
}

TableStyle standard_output_style() {
    TableStyle style;
    if (is_terminal(STDOUT_FILENO)) style.width = terminal_width(STDOUT_FILENO, 0);
    style.bold = may_colour(STDOUT_FILENO);
    return style;
}

}  // namespace strandlab
