// Fronts and errors of result rows, from their JSON: one answer for tables, summaries and charts.
#pragma once

#include "measure/pareto.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// The model error of a row (of `all`: rays that start outside and whose hit is not on a cap).
struct RowError {
    double ranking = 0;      // radii, see ranking_error
    double wrong_share = 0;  // NaN: nothing was compared
    std::optional<double> distance_p99;
    bool hit_or_miss_only = false;
};
RowError row_error(const nlohmann::ordered_json& row);

/// Median trace time in ms, and bytes that stay while tracing; NaN where they were not measured.
double row_time(const nlohmann::ordered_json& row);
double row_memory(const nlohmann::ordered_json& row);

/// Whether Embree made the row: a second opinion, which is on no front.
bool is_second_opinion(const nlohmann::ordered_json& row);

/// Whether one may choose the row's primitive: measuring aids (`null`) and Embree are there to compare with.
bool is_choice(const nlohmann::ordered_json& row);

/// Equal for rows whose times, memory and errors may be compared: class and name of the device, model,
/// instances, ray set. Software and hardware traversal are never equal.
std::string comparable_group(const nlohmann::ordered_json& row);

/// On which Pareto fronts a row is.
struct FrontMarks {
    bool time_error = false, memory_error = false;  // against RowError::ranking
    bool time_wrong = false, memory_wrong = false;  // against RowError::wrong_share

    bool any() const { return time_error || memory_error || time_wrong || memory_wrong; }
};

/// The marks of each row, among the rows of its group. What is no choice is on no front.
std::vector<FrontMarks> pareto_fronts(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
