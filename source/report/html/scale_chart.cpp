#include "report/html/scale_chart.h"

#include "report/html/plot.h"
#include "report/html/row_groups.h"
#include "report/scale_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace strandlab {

using Json = nlohmann::ordered_json;

namespace {

constexpr double panel_width = 340, panel_height = 250, legend_height = 20;
constexpr size_t panels_in_row = 3;

struct Line {
    size_t series, row;
    std::vector<std::pair<double, double>> points;
};

std::vector<Line> lines_of(std::span<const Json> rows, const std::vector<ScaleSeries>& all,
                           const ScaleCost& cost) {
    std::vector<Line> lines;
    for (size_t i = 0; i < all.size(); ++i) {
        Line line{i, all[i].rows.front(), scale_points(rows, all[i], cost)};
        if (!line.points.empty()) lines.push_back(std::move(line));
    }
    return lines;
}

void draw_panel(Drawing& drawing, const PlotArea& area, const std::vector<Line>& lines,
                const std::string& title) {
    std::vector<double> curves, values;
    for (const Line& line : lines)
        for (const auto& [x, y] : line.points) curves.push_back(x), values.push_back(y);
    const LogAxis x(curves, area.left + 8, area.right - 8), y(values, area.bottom - 8, area.top + 8);
    draw_grid(drawing, area, x, y);
    for (const Line& line : lines) {
        std::vector<LinePoint> points;
        for (const auto& [size, value] : line.points) points.push_back({x.at(size), y.at(value)});
        draw_line(drawing, line.series, points, line.row);
    }
    draw_axes(drawing, area, "curves", "");
    drawing.text("title middle", (area.left + area.right) / 2, area.top - 4, title);
}

}  // namespace

std::string scale_chart(std::span<const Json> rows) {
    const std::vector<ScaleSeries> all = scale_series(rows);
    if (all.empty()) return "";
    const size_t panel_rows = (scale_costs().size() + panels_in_row - 1) / panels_in_row;
    const size_t legend_rows = (all.size() + panels_in_row - 1) / panels_in_row;
    const double top = 16 + legend_height * double(legend_rows);
    Drawing drawing(panel_width * panels_in_row, top + panel_height * double(panel_rows),
                    "Cost against the number of curves: " + all.front().device);
    for (size_t i = 0; i < all.size(); ++i) {
        const double x = 20 + panel_width * double(i % panels_in_row),
                     y = 16 + legend_height * double(i / panels_in_row);
        drawing.mark("k", i, x, y - 4);
        drawing.text("key", x + 12, y, all[i].primitive + ", " + all[i].rays);
    }
    for (size_t i = 0; i < scale_costs().size(); ++i) {
        const ScaleCost& cost = scale_costs()[i];
        const double left = panel_width * double(i % panels_in_row),
                     high = top + panel_height * double(i / panels_in_row);
        const bool is_bytes = std::string_view(cost.field).starts_with("memory");
        draw_panel(drawing, {left + 60, high + 20, left + panel_width - 16, high + panel_height - 46},
                   lines_of(rows, all, cost), fmt::format("{}, {}", cost.name, is_bytes ? "bytes" : "ms"));
    }
    return drawing.file();
}

}  // namespace strandlab
