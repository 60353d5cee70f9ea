// What tracing rays took: counted by instrumented shaders, never where time is measured.
#pragma once

#include <cstdint>
#include <span>

namespace strandlab {

/// Of one ray; layout as shaders/shared/trace.glsl counts.
struct RayWork {
    uint32_t leaves = 0;      // intersector invocations
    uint32_t searched = 0;    // of these, with at least one iteration
    uint32_t iterations = 0;  // of searches: cones or capsules tried, steps of refinement
    uint32_t reports = 0;     // hits reported, each nearer than the one before
};
static_assert(sizeof(RayWork) == 16);

/// Of all rays together.
struct WorkCounts {
    uint64_t rays = 0;
    uint64_t leaves = 0, searched = 0, iterations = 0, reports = 0;
    uint32_t most_leaves = 0, most_iterations = 0;  // of one ray

    void add(const RayWork& ray);
    double leaves_per_ray() const { return per(leaves, rays); }
    /// Share of leaves that a ray enters without a hit there that is nearer than what it has.
    double false_entry_share() const { return per(leaves - reports, leaves); }
    /// Share of leaves that no early test turned away.
    double searched_share() const { return per(searched, leaves); }
    double iterations_per_ray() const { return per(iterations, rays); }
    double reports_per_ray() const { return per(reports, rays); }

  private:
    /// NaN of nothing.
    static double per(uint64_t count, uint64_t whole) { return double(count) / double(whole); }
};

WorkCounts sum_of(std::span<const RayWork> rays);

}  // namespace strandlab
