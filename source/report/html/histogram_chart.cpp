// How many errors there are of each size.
#include "report/html/axis.h"
#include "report/html/charts.h"
#include "report/html/error_bins.h"
#include "report/html/markup.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace strandlab {
namespace {

constexpr double width = 390, left = 118, right = 366, top = 8, row_height = 26;
/// More than this are too many to look at: then only those of rows on a front are drawn.
constexpr size_t most_rows = 24;

struct Histogram {
    size_t row;
    ErrorBins shares;
};

std::vector<Histogram> histograms_of(const ChartRows& data, const RowGroup& group, Against against) {
    std::vector<Histogram> all;
    for (const size_t i : group.all())
        if (const auto bins = error_bins(data.rows[i], against)) all.push_back({i, *bins});
    if (all.size() > most_rows)
        std::erase_if(all, [&](const Histogram& one) { return !data.marks[one.row].any(); });
    return all;
}

/// The bins from the first that any row fills to the last.
struct Range {
    size_t first = ~size_t(0), last = 0;

    explicit Range(const std::vector<Histogram>& all) {
        for (const Histogram& one : all)
            for (size_t bin = 0; bin < one.shares.size(); ++bin)
                if (one.shares[bin] > 0) first = std::min(first, bin), last = std::max(last, bin);
    }
    double bin_width() const { return (right - left) / static_cast<double>(last - first + 1); }
    double from(size_t bin) const { return left + bin_width() * static_cast<double>(bin - first); }
};

std::string bars_of(const Histogram& one, const Range& range, double bottom) {
    std::string bars;
    for (size_t bin = range.first; bin <= range.last; ++bin) {
        const double share = one.shares[bin];
        if (!(share > 0)) continue;
        const double height = std::max(1.0, share * (row_height - 6));  // what is there is seen
        bars += box_path(range.from(bin) + 0.5, bottom - height, range.bin_width() - 1, height);
    }
    return bars;
}

}  // namespace

std::optional<Drawing> histogram_chart(const ChartRows& data, const RowGroup& group, Against against) {
    const std::vector<Histogram> all = histograms_of(data, group, against);
    if (all.empty()) return std::nullopt;
    const Range range(all);
    const double bottom = top + row_height * static_cast<double>(all.size());
    Drawing drawing(
        width, bottom + 40,
        fmt::format("Histograms of errors {}: {}",
                    against == Against::curves ? "of the model" : "of the intersector", group.title()));
    const std::string y_grid = fmt::format("V{}", coordinate(bottom));
    std::string grid;
    // An edge every so many bins, so that their figures do not meet.
    const size_t step = (range.last - range.first) / 6 + 1;
    for (size_t bin = std::max<size_t>(range.first, 1); bin <= range.last + 1; bin += step) {
        grid += fmt::format("M{} {}{}", coordinate(range.from(bin)), coordinate(top), y_grid);
        if (lower_edge(bin) > 0)
            drawing.text("tick middle", range.from(bin), bottom + 15, tick_label(lower_edge(bin)));
    }
    drawing.path("grid", grid);
    std::string lines;
    for (size_t i = 0; i < all.size(); ++i) {
        const double base = top + row_height * static_cast<double>(i + 1);
        const auto& row = data.rows[all[i].row];
        drawing.path(fmt::format("bar s{}", series_of(row)), bars_of(all[i], range, base));
        drawing.text("name end", left - 6, base - 6, shortened(row_label(row), 20));
        drawing.target(0, base - row_height, width, row_height, all[i].row);
        lines += fmt::format("M{} {}H{}", coordinate(left), coordinate(base), coordinate(right));
    }
    drawing.path("axis", lines);
    drawing.text("title middle", (left + right) / 2, bottom + 33,
                 against == Against::curves ? "|dt| against the curves, radii"
                                            : "|dt| against its own surface, radii");
    return drawing;
}

}  // namespace strandlab
