#include "report/html/drawing.h"

#include "report/html/markup.h"
#include "report/html/resources.h"
#include "report/table.h"

#include <fmt/format.h>

#include <array>

namespace strandlab {
namespace {

/// Marks of about equal area around the origin.
constexpr std::array<std::string_view, series_count> shapes{
    "M-4.4 0a4.4 4.4 0 1 0 8.8 0a4.4 4.4 0 1 0-8.8 0z",           // disc
    "M-3.9-3.9h7.8v7.8h-7.8z",                                    // square
    "M0-5.2 5 3.6h-10z",                                          // triangle
    "M0-5.6 4.9 0 0 5.6-4.9 0z",                                  // diamond
    "M0 5.2 5-3.6h-10z",                                          // triangle, downwards
    "M-1.7-5h3.4v3.3h3.3v3.4h-3.3v3.3h-3.4v-3.3h-3.3v-3.4h3.3z",  // plus
    "M0-5.3 5-1.7 3.1 4.3h-6.2l-1.9-6z",                          // pentagon
    "M-5-2.9 0-5.7 5-2.9v5.8l-5 2.8-5-2.8z",                      // hexagon
};

std::string row_attribute(size_t row) {
    return row == Drawing::no_row ? "" : fmt::format(" data-r=\"{}\"", row);
}

}  // namespace

void Drawing::end_marks() {
    if (!marks_style_.empty()) body_ += "</g>";
    marks_style_.clear();
}

void Drawing::line(std::string_view style, double x1, double y1, double x2, double y2) {
    path(style, fmt::format("M{} {}L{} {}", coordinate(x1), coordinate(y1), coordinate(x2), coordinate(y2)));
}

void Drawing::rectangle(std::string_view style, double x, double y, double width, double height) {
    end_marks();
    body_ += fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", style,
                         coordinate(x), coordinate(y), coordinate(width), coordinate(height));
}

void Drawing::target(double x, double y, double width, double height, size_t row) {
    path("target", box_path(x, y, width, height), row);
}

void Drawing::path(std::string_view style, std::string_view data, size_t row) {
    end_marks();
    body_ += fmt::format("<path class=\"{}\" d=\"{}\"{}/>", style, data, row_attribute(row));
}

void Drawing::text(std::string_view style, double x, double y, std::string_view text) {
    end_marks();
    body_ += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>", style, coordinate(x),
                         coordinate(y), escape_markup(text));
}

void Drawing::upward_text(std::string_view style, double x, double y, std::string_view text) {
    end_marks();
    body_ += fmt::format("<text class=\"{} middle\" transform=\"translate({} {})rotate(-90)\">{}</text>",
                         style, coordinate(x), coordinate(y), escape_markup(text));
}

void Drawing::mark(std::string_view style, size_t series, double x, double y, size_t row) {
    const size_t shape = series % series_count;
    const std::string group = fmt::format("{} s{}", style, shape);
    if (group != marks_style_) {
        end_marks();
        body_ += fmt::format("<g class=\"{}\">", group);
        marks_style_ = group;
    }
    body_ += fmt::format("<use href=\"#m{}\" x=\"{}\" y=\"{}\"{}/>", shape, coordinate(x), coordinate(y),
                         row_attribute(row));
}

std::string box_path(double x, double y, double width, double height) {
    return fmt::format("M{} {}h{}v{}h{}z", coordinate(x), coordinate(y), coordinate(width),
                       coordinate(height), coordinate(-width));
}

std::string Drawing::inside_page() const {
    // Wide ones keep their size and scroll.
    const std::string size = width_ > 560 ? fmt::format(" wide\" width=\"{}", coordinate(width_)) : "";
    return fmt::format(
        "<svg class=\"chart{4}\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\">{3}</svg>",
        coordinate(width_), coordinate(height_), escape_markup(title_), body(), size);
}

std::string Drawing::file() const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" width=\"{0}\" height=\"{1}\" viewBox=\"0 "
        "0 "
        "{0} {1}\">\n<title>{2}</title>\n<style>\n{3}</style>\n<defs>{4}</defs>\n"
        "<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n{5}\n</svg>\n",
        coordinate(width_), coordinate(height_), escape_markup(title_), resource("chart.css"),
        mark_definitions(), body());
}

std::string mark_definitions() {
    std::string definitions;
    for (size_t i = 0; i < shapes.size(); ++i)
        definitions += fmt::format(
            "<path id=\"m{0}\" d=\"{1}\"/><marker id=\"l{0}\" viewBox=\"-6 -6 12 12\" markerWidth=\"8\" "
            "markerHeight=\"8\" markerUnits=\"userSpaceOnUse\"><path class=\"t s{0}\" d=\"{1}\"/></marker>",
            i, shapes[i]);
    return definitions;
}

double text_width(std::string_view text, double size) {
    return 0.56 * size * static_cast<double>(display_width(text));
}

std::string shortened(std::string_view text, size_t most) {
    if (display_width(text) <= most) return std::string(text);
    size_t end = 0;
    for (size_t seen = 0; end < text.size(); ++end) {
        const bool starts = (static_cast<unsigned char>(text[end]) & 0xC0) != 0x80;
        if (starts && ++seen == most) break;
    }
    return std::string(text.substr(0, end)) + "…";
}

}  // namespace strandlab
