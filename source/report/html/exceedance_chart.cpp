// How large errors are, and how often.
#include "report/html/charts.h"
#include "report/html/error_bins.h"
#include "report/html/plot.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

constexpr double width = 390, height = 300, left = 54, right = 374, bottom = 254;
/// More lines than this cannot be told apart: then only those of rows on a front are drawn.
constexpr size_t most_lines = 12;

/// So large a share of rays is off by more than a distance.
struct Step {
    double error, share;
};

struct Tail {
    size_t row;
    std::vector<Step> steps;
};

/// The shares beyond the edges of the bins: from the last edge that all rays lie beyond to the first that
/// none does.
void add_edges(std::vector<Step>& steps, const ErrorBins& bins) {
    double within = 0;
    for (size_t bin = 0; bin + 1 < bins.size(); ++bin) {
        within += bins[bin];
        if (within == 0 && bins[bin + 1] == 0) continue;
        if (within > 1 - 1e-12) return;
        steps.push_back({lower_edge(bin + 1), 1 - within});
    }
}

std::vector<Step> steps_of(const Json& row, Against against) {
    const std::string path = distance_path(against);
    std::vector<Step> steps;
    if (const auto bins = error_bins(row, against)) add_edges(steps, *bins);
    constexpr std::array<std::pair<const char*, double>, 4> percentiles{
        {{"p50", 0.5}, {"p95", 0.05}, {"p99", 0.01}, {"p999", 0.001}}};
    const double count = number_or_nan(row, path + "count");
    for (const auto& [name, share] : percentiles) {
        const double error = number_or_nan(row, path + name);
        if (error > 0 && std::isfinite(error) && share * count >= 1) steps.push_back({error, share});
    }
    const double largest = number_or_nan(row, path + "max");
    if (largest > 0 && std::isfinite(largest) && count >= 1) steps.push_back({largest, 1 / count});
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.error < b.error; });
    for (size_t i = 1; i < steps.size(); ++i) steps[i].share = std::min(steps[i].share, steps[i - 1].share);
    return steps;
}

std::vector<Tail> curves_of(const ChartRows& data, const RowGroup& group, Against against) {
    std::vector<Tail> curves;
    for (const size_t i : group.all())
        if (auto steps = steps_of(data.rows[i], against); !steps.empty())
            curves.push_back({i, std::move(steps)});
    if (curves.size() > most_lines)
        std::erase_if(curves, [&](const Tail& tail) { return !data.marks[tail.row].any(); });
    return curves;
}

}  // namespace

std::optional<Drawing> exceedance_chart(const ChartRows& data, const RowGroup& group, Against against) {
    const std::vector<Tail> curves = curves_of(data, group, against);
    if (curves.empty()) return std::nullopt;
    Drawing drawing(
        width, height,
        fmt::format("How often errors {} exceed a distance: {}",
                    against == Against::curves ? "of the model" : "of the intersector", group.title()));
    std::vector<size_t> members;
    std::vector<double> errors, shares;
    for (const Tail& curve : curves) {
        members.push_back(curve.row);
        for (const Step& step : curve.steps) errors.push_back(step.error), shares.push_back(step.share);
    }
    shares.push_back(1);
    const double top = draw_legend(drawing, data.rows, members, left, 14) + 2;
    const LogAxis x(errors, left + 8, right - 8), y(shares, bottom - 8, top + 4);
    const PlotArea area{left, top, right, bottom};
    draw_grid(drawing, area, x, y, 100);
    for (const Tail& curve : curves) {
        std::vector<LinePoint> points;
        for (const Step& step : curve.steps) points.push_back({x.at(step.error), y.at(step.share)});
        draw_line(drawing, series_of(data.rows[curve.row]), points, curve.row);
    }
    draw_axes(
        drawing, area,
        against == Against::curves ? "|dt| against the curves, radii" : "|dt| against its own surface, radii",
        "rays beyond that distance, %");
    return drawing;
}

}  // namespace strandlab
