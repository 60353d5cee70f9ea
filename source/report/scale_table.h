// Cost against the number of curves.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace strandlab {

/// A cost of rows: its name, and its field.
struct ScaleCost {
    const char* name;
    const char* field;
};
std::span<const ScaleCost> scale_costs();

/// What one primitive costs with one ray set and device, by its number of curves.
struct ScaleSeries {
    std::string device, rays, primitive;
    std::vector<size_t> rows;  // in the order of their curves
};
std::vector<ScaleSeries> scale_series(std::span<const nlohmann::ordered_json> rows);

/// Curves and cost of the rows of a series; those without are left out, and orders of leaves that an earlier
/// run had left (which cost a read).
std::vector<std::pair<double, double>> scale_points(std::span<const nlohmann::ordered_json> rows,
                                                    const ScaleSeries& series, const ScaleCost& cost);

/// The exponent b of cost = a n^b by least squares of the logarithms; nothing for fewer than two sizes.
/// Points that are not positive are left out.
std::optional<double> fitted_exponent(std::span<const std::pair<double, double>> points);

/// The exponents of each series, as a table: 1 is in proportion to the curves, 0 not at all.
std::string scale_table(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
