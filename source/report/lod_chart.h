// A chart of levels of detail against distance, as SVG.
#pragma once

#include <string>
#include <vector>

namespace strandlab {

/// One distance. Sizes and times are relative to full detail.
struct LodPoint {
    double distance = 1, detail = 1;
    double coverage_bias = 0, coverage_rms = 0, transmittance_bias = 0;  // shares
    double bytes = 1, build = 1, trace = 1;
};

/// Two panels over a common axis of distances (doubling): errors in percent above, cost relative to full
/// detail (logarithmic) below. The text is ASCII; title is escaped.
std::string lod_chart(const std::string& title, const std::vector<LodPoint>& points);

}  // namespace strandlab
