#include "strands/strands.h"

#include <fmt/core.h>

namespace strandlab {

std::vector<std::string> warnings(const ImportReport& report, const CurveOptions& options) {
    std::vector<std::string> lines;
    if (report.short_strands > 0)
        lines.push_back(fmt::format("{} strands with fewer than two distinct points were left out",
                                    report.short_strands));
    if (report.repeated_points > 0)
        lines.push_back(fmt::format("{} repeated points were dropped", report.repeated_points));
    if (report.negative_radii > 0)
        lines.push_back(fmt::format("{} negative radii were set to 0", report.negative_radii));
    if (report.gaps > 0)
        lines.push_back(
            fmt::format("{} curves do not begin where the one before in their strand ends", report.gaps));
    if (report.radii_from_options)
        lines.push_back(fmt::format("the model has no radii: {:g} at the root to {:g} at the tip was used",
                                    options.root_radius, options.tip_radius));
    return lines;
}

}  // namespace strandlab
