// Rows of several files as one result: shards, resumed and repeated runs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// One row for each key, the last of those with the same one, in the order of the sweeps' first rows and,
/// within a sweep, of its cases. Rows without a key are kept as they are.
std::vector<nlohmann::ordered_json> merged_rows(std::vector<nlohmann::ordered_json> rows);

/// The cases of the rows' sweeps that no row holds, "curly 640x360 primary lss", in the order of the cases.
std::vector<std::string> missing_cases(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
