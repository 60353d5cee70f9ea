// The rows of a benchmark as a terminal table.
#pragma once

#include "report/result_row.h"

#include <span>
#include <string>

namespace strandlab {

/// A heading (model, rays, camera's picture) and one row per primitive; all rows belong to one model and
/// ray set.
std::string bench_table(std::span<const ResultRow> rows);

/// How to read the columns.
std::string bench_legend();

}  // namespace strandlab
