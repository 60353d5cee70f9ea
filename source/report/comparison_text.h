// The errors of a ray set as people read them in a terminal.
#pragma once

#include "measure/comparison.h"
#include "report/table.h"

#include <string>

namespace strandlab {

/// "3 of 1,234 (0.24 %, 95 %: 0.05 % to 0.71 %)"; of nothing seen only the upper bound: "0 of 1,234
/// (95 %: below 0.24 %)".
std::string count_text(const Count& count);

/// Outcomes of the groups that have rays: a row for each class, a column for each group.
Table outcome_table(const Comparison& comparison);

/// Percentiles of what was measured of the decisive matches, one row a measure. Empty for hit-or-miss sets.
Table measure_table(const Comparison& comparison);

/// Both tables, the share of undecided rays, and a line that says so when the set gets no verdict.
std::string comparison_text(const Comparison& comparison, const TableStyle& style);

}  // namespace strandlab
