// Bins of |dt| / r that a row has measured.
#pragma once

#include "measure/comparison.h"
#include "report/html/charts.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>

namespace strandlab {

/// Where a row holds its distances: "model_error.all.distance." or "intersector_error.decisive.distance.".
std::string distance_path(Against against);

/// Shares of the matches by the decade of their distance, as Percentiles::decades has them.
using ErrorBins = std::array<double, std::tuple_size_v<decltype(Percentiles::decades)>>;

/// Nothing where the row has no bins, other bins, or no matches.
std::optional<ErrorBins> error_bins(const nlohmann::ordered_json& row, Against against);

/// The smallest distance of a bin; 0 for the first.
double lower_edge(size_t bin);

}  // namespace strandlab
