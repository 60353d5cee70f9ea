// Where the time of a trace goes: what an instrumented trace counts, and the floors of the same traversal.
#pragma once

#include "measure/bench_case.h"
#include "trace/work_counts.h"

#include <optional>
#include <vector>

namespace strandlab {

/// Of one case. The instrumented trace is one of its own: the times are those of the shaders that bench
/// times.
struct TraceProfile {
    std::optional<WorkCounts> work;  // none for triangles on a device: its own test tells nothing
    size_t hits = 0;                 // rays that hit
    double trace_ms = 0;             // medians of interleaved rounds, as below
    /// With an intersector that always misses: the ray is never shortened, every leaf along it is met.
    std::optional<double> floor_ms;
    /// The same with each ray cut at its hit: the floor of finding it, which no intersector goes below. None
    /// for shadow rays, whose hits are not the nearest.
    std::optional<double> floor_at_hit_ms;
    std::vector<ShaderStatistic> shaders;  // what the driver tells of the shaders

    /// Leaves etc. of rays that are cut at their hits: what the order in which hits are found costs is the
    /// difference to `work`.
    std::optional<WorkCounts> work_at_hit;
};

/// input.samples rounds of the traces in turns; seed of their order.
TraceProfile profile_of(const CaseInput& input, const TracedScene& scene, const MeasuredRays& rays,
                        uint64_t seed);

}  // namespace strandlab
