// Result rows as terminal tables.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace strandlab {

/// A heading (model, rays) and a table for each set of rows of one model and ray set, in the order of their
/// first rows; within a table the order is that of the rows.
std::string result_table(std::span<const nlohmann::ordered_json> rows);

/// How to read the columns.
std::string result_legend();

}  // namespace strandlab
