// Charts as SVG: one drawing, inside the page (coloured by its style sheet) and as a file of its own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace strandlab {

/// Shapes and colours that tell primitives apart; a series is a number, used modulo this.
inline constexpr size_t series_count = 8;

/// A drawing under construction; x to the right, y down, in pixels. Colours come from classes, which
/// chart.css defines. Classes and path data are the caller's own words; every text is escaped.
class Drawing {
  public:
    /// title: what the chart shows, for readers that cannot see it.
    Drawing(double width, double height, std::string title)
        : width_(width), height_(height), title_(std::move(title)) {}

    void line(std::string_view style, double x1, double y1, double x2, double y2);
    void rectangle(std::string_view style, double x, double y, double width, double height);
    /// A path; row: the result row that it stands for, if any.
    void path(std::string_view style, std::string_view data, size_t row = no_row);
    /// A text at its base line; style has "middle" or "end" where x is not its start.
    void text(std::string_view style, double x, double y, std::string_view text);
    /// A text that reads upwards, centred at (x, y).
    void upward_text(std::string_view style, double x, double y, std::string_view text);
    /// The mark of a series, centred. Marks of one style and series are best drawn one after the other.
    void mark(std::string_view style, size_t series, double x, double y, size_t row = no_row);
    /// A rectangle that cannot be seen and stands for a row.
    void target(double x, double y, double width, double height, size_t row);
    void set_height(double height) { height_ = height; }

    double width() const { return width_; }
    double height() const { return height_; }

    /// As an element of the page.
    std::string inside_page() const;
    /// As a file: light colours, fonts and marks inside.
    std::string file() const;

    static constexpr size_t no_row = ~size_t(0);

  private:
    std::string body() const { return marks_style_.empty() ? body_ : body_ + "</g>"; }
    void end_marks();

    double width_, height_;
    std::string title_, body_;
    std::string marks_style_;  // of the group of marks that is open
};

/// The shapes of the series as definitions (#m0 and on), and small ones for lines (#l0 and on), once in a
/// page.
std::string mark_definitions();

/// Path data of a rectangle.
std::string box_path(double x, double y, double width, double height);

/// About how wide a text is at a font size.
double text_width(std::string_view text, double size);

/// The text, with its end cut off and "…" where it has more code points than that.
std::string shortened(std::string_view text, size_t most);

}  // namespace strandlab
