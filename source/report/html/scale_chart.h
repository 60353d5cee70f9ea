// Cost against the number of curves, as SVG.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace strandlab {

/// A panel for each cost (report/scale_table.h), both axes logarithmic, a line for each primitive and ray
/// set; the text of an SVG file. Empty without rows.
std::string scale_chart(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
