// The published table of hair primitives, with the columns that it lacks.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace strandlab {

/// For each model with primary rays: technique, frame time, memory and primitives as the table states them
/// (its memory is that of the buffers that the program fills: build input and records, no acceleration
/// structure), and beside them spread, build time, acceleration structure, error and resolution.
std::string article_table(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
