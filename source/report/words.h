// What result rows say, in sentences: which primitive to choose.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// One sentence for every set of comparable rows (device, model, rays): the fastest and the smallest
/// primitive whose model error stays within `limit` radii for 99 % of the rays, and the fastest of all where
/// that is another one. Diagnostic primitives and Embree are not chosen.
std::vector<std::string> result_words(std::span<const nlohmann::ordered_json> rows, double limit = 0.1);

}  // namespace strandlab
