// What pictures lose when the hair is farther away.
#include "report/html/charts.h"
#include "report/html/plot.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

constexpr PlotArea area{64, 40, 374, 254};

struct Sample {
    double scale, value;
};

/// A row's figure at each distance, 0 too.
std::vector<Sample> samples_of(const Json& row, const std::string& figure) {
    std::vector<Sample> samples;
    const Json* list = field_at(row, "distances");
    if (!list || !list->is_array()) return samples;
    for (const Json& item : *list) {
        const Sample sample{number_or_nan(item, "scale"), std::abs(number_or_nan(item, figure))};
        if (sample.scale >= 1e-6 && sample.scale <= 1e6 && std::isfinite(sample.value))
            samples.push_back(sample);
    }
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.scale < b.scale; });
    return samples;
}

/// What has no place on a logarithmic axis is said in words.
std::string zero_note(const std::vector<std::string>& labels) {
    std::string text;
    for (const std::string& label : labels) text += (text.empty() ? "" : ", ") + label;
    return shortened(text + ": 0 at every distance", 56);
}

}  // namespace

std::optional<Drawing> distance_chart(const ChartRows& data, const RowGroup& group, const std::string& figure,
                                      const std::string& title) {
    std::vector<std::pair<size_t, std::vector<Sample>>> lines;
    std::vector<double> scales, values;
    std::vector<size_t> members;
    std::vector<std::string> zeros;
    for (const size_t i : group.all()) {
        std::vector<Sample> samples = samples_of(data.rows[i], figure);
        if (samples.empty()) continue;
        for (const Sample& sample : samples) scales.push_back(sample.scale);
        std::erase_if(samples, [](const Sample& sample) { return sample.value == 0; });
        for (const Sample& sample : samples) values.push_back(sample.value);
        if (samples.empty()) zeros.push_back(row_label(data.rows[i]));
        members.push_back(i);
        lines.emplace_back(i, std::move(samples));
    }
    if (values.empty()) return std::nullopt;
    Drawing drawing(390, 300, fmt::format("{}: {}", title, group.title()));
    draw_legend(drawing, data.rows, members, area.left, 14);
    const auto [nearest, farthest] = std::minmax_element(scales.begin(), scales.end());
    const LogAxis x =
        LogAxis::doubling(*nearest, std::max(*farthest, 2 * *nearest), area.left + 8, area.right - 8);
    const LogAxis y(values, area.bottom - (zeros.empty() ? 8 : 24), area.top + 8);
    if (!zeros.empty()) drawing.text("tick", area.left + 8, area.bottom - 8, zero_note(zeros));
    draw_grid(drawing, area, x, y);
    for (const auto& [row, samples] : lines) {
        if (samples.empty()) continue;
        std::vector<LinePoint> points;
        for (const Sample& sample : samples) points.push_back({x.at(sample.scale), y.at(sample.value)});
        draw_line(drawing, series_of(data.rows[row]), points, row);
    }
    draw_axes(drawing, area, "distance, times that of the picture", title);
    return drawing;
}

}  // namespace strandlab
