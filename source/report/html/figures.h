// The charts of a report as files for a paper.
#pragma once

#include "report/merged_results.h"

#include <string>

namespace strandlab {

/// Writes every chart as an SVG file of its own into a folder, which is made where it is missing:
/// curly.primary_rays.llvmpipe.time-error.svg and so on. Returns how many. Throws Error (bad_input) where a
/// file cannot be written.
size_t write_figures(const MergedResults& results, const std::string& folder);

}  // namespace strandlab
