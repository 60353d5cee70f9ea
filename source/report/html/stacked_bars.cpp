#include "report/html/stacked_bars.h"

#include "report/html/axis.h"
#include "report/html/markup.h"
#include "report/text_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

constexpr double width = 460, left = 142, right = 410, row_height = 20;

bool can_be_drawn(const StackedBar& bar) {
    return std::all_of(bar.sizes.begin(), bar.sizes.end(),
                       [](double size) { return size >= 0 && std::isfinite(size); });
}

/// From the left edge on, wrapped; returns where the bars may begin.
double draw_key(Drawing& drawing, const std::vector<BarPart>& parts) {
    double x = 4, y = 6;
    for (const BarPart& part : parts) {
        const double part_width = 17 + text_width(part.name, 11) + 14;
        if (x > 4 && x + part_width > width) x = 4, y += 18;
        drawing.rectangle(part.style, x, y, 12, 12);
        drawing.text("key", x + 17, y + 10, part.name);
        x += part_width;
    }
    return y + 22;
}

void draw_names(Drawing& drawing, const StackedBar& bar, double end, double y) {
    drawing.text("name end", left - 6, y + 14, shortened(bar.label, 23));
    drawing.text("value", end + 5, y + 14, significant(bar.figure));
    drawing.target(0, y, width, row_height, bar.row);
}

/// The parts of a bar, each added to the path of all parts of its kind; returns where the bar ends.
double add_bar(std::vector<std::string>& paths, const StackedBar& bar, const LinearAxis& axis, double y) {
    double from = 0;
    for (size_t k = 0; k < bar.sizes.size(); ++k) {
        const double to = from + bar.sizes[k], pixels = axis.at(to) - axis.at(from);
        // What is there is seen.
        if (to > from) paths[k] += box_path(axis.at(from), y + 3, std::max(0.6, pixels), row_height - 6);
        from = to;
    }
    return axis.at(from);
}

}  // namespace

double StackedBar::total() const {
    double sum = 0;
    for (const double size : sizes) sum += size;
    return sum;
}

bool StackedBars::has_bars() const { return std::any_of(bars.begin(), bars.end(), can_be_drawn); }

Drawing StackedBars::draw() const {
    std::vector<StackedBar> drawn;
    std::copy_if(bars.begin(), bars.end(), std::back_inserter(drawn), can_be_drawn);
    const size_t all = drawn.size();
    if (all > most_bars) std::erase_if(drawn, [](const StackedBar& bar) { return !bar.chosen; });
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const StackedBar& a, const StackedBar& b) { return a.figure < b.figure; });
    Drawing drawing(width, 0, title);
    const double top = draw_key(drawing, parts);
    const double bottom = top + row_height * static_cast<double>(drawn.size());
    drawing.set_height(bottom + (drawn.size() < all ? 56 : 40));
    double highest = 0;
    for (const StackedBar& bar : drawn) highest = std::max(highest, bar.total());
    const LinearAxis axis(highest, left, right);
    std::string grid;
    for (const Tick& tick : axis.ticks()) {
        grid +=
            fmt::format("M{} {}V{}", coordinate(axis.at(tick.value)), coordinate(top), coordinate(bottom));
        drawing.text("tick middle", axis.at(tick.value), bottom + 15, tick.label);
    }
    drawing.path("grid", grid);
    std::vector<std::string> paths(parts.size());
    std::vector<double> ends;
    const auto y_of = [&](size_t i) { return top + row_height * static_cast<double>(i); };
    for (size_t i = 0; i < drawn.size(); ++i) ends.push_back(add_bar(paths, drawn[i], axis, y_of(i)));
    for (size_t k = 0; k < parts.size(); ++k)
        if (!paths[k].empty()) drawing.path(parts[k].style, paths[k]);
    for (size_t i = 0; i < drawn.size(); ++i) draw_names(drawing, drawn[i], ends[i], y_of(i));
    drawing.line("axis", left, top, left, bottom);
    drawing.text("title middle", width / 2, bottom + 33, axis_title);
    if (drawn.size() < all)
        drawing.text("tick middle", width / 2, bottom + 50,
                     fmt::format("{} of {} rows: those on a front", drawn.size(), all));
    return drawing;
}

}  // namespace strandlab
