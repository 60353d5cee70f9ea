// The charts of a report. Each draws some rows; rows without the figures that it needs are left out, and a
// chart without any row is empty.
#pragma once

#include "report/fronts.h"
#include "report/html/drawing.h"
#include "report/html/row_groups.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strandlab {

/// What charts draw: all rows and their marks, by the numbers that groups hold.
struct ChartRows {
    std::span<const nlohmann::ordered_json> rows;
    std::span<const FrontMarks> marks;
};

/// What lies along the axes of a Pareto chart.
enum class Cost { time, memory };
enum class ErrorKind { distance, wrong };

/// The trade-off of a group: cost upwards, error to the right, both logarithmic; the rows of the front are
/// filled, named and joined by a stair that no row lies below. Rows whose error is 0, or
/// of which more than 1 % of the rays are wrong, lie in bands of their own beside the axis.
std::optional<Drawing> pareto_chart(const ChartRows& data, const RowGroup& group, Cost cost, ErrorKind error);

/// Bytes per curve of each primitive of a group: structures and records, which stay, and the input of the
/// build, which does not.
std::optional<Drawing> memory_chart(const ChartRows& data, const RowGroup& group);

/// Which error: of everything against the curves, or of the intersector against its own surface.
enum class Against { curves, own_surface };

/// How many rays are off by more than a distance (in radii), both logarithmic: the bins and percentiles that
/// each row has measured, and its largest error.
std::optional<Drawing> exceedance_chart(const ChartRows& data, const RowGroup& group, Against against);

/// How many of each row's matches are off by 1e-9 to 1e3 radii: a bar for each decade that any row fills.
std::optional<Drawing> histogram_chart(const ChartRows& data, const RowGroup& group, Against against);

/// Shares of rays with each wrong outcome, as stacked bars.
std::optional<Drawing> outcome_chart(const ChartRows& data, const RowGroup& group);

/// What pictures at 1 to 32 times the distance are judged by: fields of a row's "distances", and titles.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 4> distance_figures{
    {{"coverage_bias", "|coverage bias|"},
     {"depth_bias", "|depth bias|, radii"},
     {"transmittance_bias", "|transmittance bias|"},
     {"flip", "FLIP"}}};

/// One of those figures of each row against the distance.
std::optional<Drawing> distance_chart(const ChartRows& data, const RowGroup& group, const std::string& figure,
                                      const std::string& title);

/// Family x primitive and device of a stress run: the shade is the share of wrong answers among decisive
/// rays, the colour the verdict.
std::optional<Drawing> stress_chart(std::span<const nlohmann::ordered_json> cells);

}  // namespace strandlab
