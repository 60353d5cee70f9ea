// Embree's own primitive as a row of a benchmark, and as a second opinion on a primitive.
#pragma once

#include "measure/bench_case.h"
#include "report/result_row.h"

#include <string_view>

namespace strandlab {

/// What results call Embree's primitive.
inline constexpr std::string_view embree_label = "embree round bezier";

/// The row with Embree's round Bezier curves for the primitive, and this processor for the device.
ResultRow with_embree_facts(ResultRow row);

/// A row for Embree's round Bezier curves on the scene's only model: built and traced on this processor,
/// judged by the oracle of the swept disc (its own definition) and by the common reference. `row` brings
/// scene, rays and context. Only where embree_available() and the scene is plain.
ResultRow embree_row(const CaseInput& input, const MeasuredRays& rays, ResultRow row);

/// What became of the decisive rays on which a primitive and Embree disagree.
struct SecondOpinion {
    uint64_t rays = 0;          // decisive rays where Embree's definition applies
    uint64_t agree = 0;         // hit or miss, strand and place
    uint64_t embree_wrong = 0;  // the oracle agrees with the primitive
    uint64_t primitive_wrong = 0;
    uint64_t both_wrong = 0;

    double agreement() const { return rays == 0 ? 1.0 : double(agree) / double(rays); }
};

/// Sets a primitive's hits, Embree's hits on the same surface and the oracle's side by side.
SecondOpinion second_opinion(const Curves& curves, const MeasuredRays& rays, const Hits& sample_hits,
                             const Surface& surface, const Reference& reference);

}  // namespace strandlab
