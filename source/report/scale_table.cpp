#include "report/scale_table.h"

#include "report/fronts.h"
#include "report/row_fields.h"
#include "report/table.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::array<ScaleCost, 6> costs{{{"geometry", "time.geometry_ms"},
                                          {"order", "time.order_ms"},
                                          {"build", "time.build_ms"},
                                          {"memory", "memory.resident_bytes"},
                                          {"peak", "memory.peak_bytes"},
                                          {"trace", "time.trace_ms.median"}}};

}  // namespace

std::span<const ScaleCost> scale_costs() { return costs; }

std::vector<ScaleSeries> scale_series(std::span<const Json> rows) {
    std::vector<ScaleSeries> all;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (is_second_opinion(rows[i])) continue;
        const ScaleSeries wanted{text_at(rows[i], "device.name"),
                                 text_at(rows[i], "rays.name"),
                                 text_at(rows[i], "primitive.label"),
                                 {}};
        auto found = std::find_if(all.begin(), all.end(), [&](const ScaleSeries& one) {
            return one.device == wanted.device && one.rays == wanted.rays &&
                   one.primitive == wanted.primitive;
        });
        if (found == all.end()) found = all.insert(all.end(), wanted);
        found->rows.push_back(i);
    }
    for (ScaleSeries& series : all)
        std::stable_sort(series.rows.begin(), series.rows.end(), [&](size_t a, size_t b) {
            return number_or_nan(rows[a], "model.curves") < number_or_nan(rows[b], "model.curves");
        });
    return all;
}

std::vector<std::pair<double, double>> scale_points(std::span<const Json> rows, const ScaleSeries& series,
                                                    const ScaleCost& cost) {
    std::vector<std::pair<double, double>> points;
    for (const size_t row : series.rows) {
        const bool was_read =
            cost.field == std::string_view("time.order_ms") && is_true_at(rows[row], "time.order_cached");
        const double curves = number_or_nan(rows[row], "model.curves"),
                     value = number_or_nan(rows[row], cost.field);
        if (!was_read && curves > 0 && value > 0 && std::isfinite(curves) && std::isfinite(value))
            points.emplace_back(curves, value);
    }
    return points;
}

std::optional<double> fitted_exponent(std::span<const std::pair<double, double>> points) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [size, cost] : points) {
        if (!(size > 0 && cost > 0 && std::isfinite(size) && std::isfinite(cost))) continue;
        const double a = std::log(size), b = std::log(cost);
        n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    const double spread = n * xx - x * x;
    if (n < 2 || !(spread > 1e-9 * n * xx)) return std::nullopt;
    return (n * xy - x * y) / spread;
}

std::string scale_table(std::span<const Json> rows) {
    std::vector<Column> columns{
        {"cost ~ curves^b", "", true}, {"rays", "", true}, {"curves", "from"}, {"", "to"}};
    for (const ScaleCost& cost : costs) columns.push_back({cost.name, "b"});
    Table table(columns, 2);
    for (const ScaleSeries& series : scale_series(rows)) {
        const auto curves = [&](size_t row) {
            return grouped(static_cast<uint64_t>(number_at(rows[row], "model.curves").value_or(0)));
        };
        std::vector<std::string> cells{series.primitive, series.rays, curves(series.rows.front()),
                                       curves(series.rows.back())};
        for (const ScaleCost& cost : costs) {
            const auto points = scale_points(rows, series, cost);
            const auto exponent = fitted_exponent(points);
            cells.push_back(exponent ? fmt::format("{:.2f}", *exponent) : "-");
        }
        table.add_row(std::move(cells));
    }
    return table.is_empty() ? "" : table.to_string(standard_output_style());
}

}  // namespace strandlab
