#include "report/html/plot.h"

#include "report/html/markup.h"

#include <fmt/format.h>

namespace strandlab {

void draw_grid(Drawing& drawing, const PlotArea& area, const LogAxis& x, const LogAxis& y, double y_unit) {
    std::string grid;
    for (const Tick& tick : x.ticks(7)) {
        const double at = x.at(tick.value);
        grid += fmt::format("M{} {}V{}", coordinate(at), coordinate(area.top), coordinate(area.bottom));
        drawing.text("tick middle", at, area.bottom + 15, tick.label);
    }
    for (const Tick& tick : y.ticks(8)) {
        const double at = y.at(tick.value);
        grid += fmt::format("M{} {}H{}", coordinate(area.left), coordinate(at), coordinate(area.right));
        drawing.text("tick end", area.left - 6, at + 4, tick_label(y_unit * tick.value));
    }
    drawing.path("grid", grid);
}

void draw_axes(Drawing& drawing, const PlotArea& area, const std::string& x_title,
               const std::string& y_title) {
    drawing.path("axis", fmt::format("M{} {}V{}H{}", coordinate(area.left), coordinate(area.top),
                                     coordinate(area.bottom), coordinate(area.right)));
    drawing.text("title middle", (area.left + area.right) / 2, area.bottom + 34, x_title);
    drawing.upward_text("title", 14, (area.top + area.bottom) / 2, y_title);
}

void draw_line(Drawing& drawing, size_t series, std::span<const LinePoint> points, size_t row) {
    std::string data;
    for (const LinePoint& point : points)
        data += fmt::format("{}{} {}", data.empty() ? "M" : "L", coordinate(point.x), coordinate(point.y));
    drawing.path(fmt::format("line s{}", series % series_count), data, row);
}

}  // namespace strandlab
