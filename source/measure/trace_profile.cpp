#include "measure/trace_profile.h"

#include "measure/interleave.h"
#include "measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace strandlab {
namespace {

/// The rays, each ending just beyond its hit, so that the hit is still found.
Rays cut_at_hits(Rays rays, const Hits& hits) {
    for (size_t i = 0; i < rays.rays.size(); ++i)
        if (hits.hits[i].is_hit())
            rays.rays[i].tmax = std::min(
                rays.rays[i].tmax, std::nextafter(hits.hits[i].t, std::numeric_limits<float>::infinity()));
    return rays;
}

std::optional<WorkCounts> counted(const TracedScene& scene, TracedRays& rays, bool shadow) {
    const auto work = scene.count_work(rays, shadow);
    return work ? std::optional(sum_of(*work)) : std::nullopt;
}

}  // namespace

TraceProfile profile_of(const CaseInput& input, const TracedScene& scene, const MeasuredRays& rays,
                        uint64_t seed) {
    TraceProfile profile;
    const std::unique_ptr<TracedRays> whole = input.device.upload(rays.rays, input.options.normals);
    scene.run(*whole, rays.shadow);
    const Hits hits = whole->hits();
    for (const Hit& hit : hits.hits) profile.hits += hit.is_hit() ? 1 : 0;
    std::unique_ptr<TracedRays> cut;
    if (!rays.shadow) cut = input.device.upload(cut_at_hits(rays.rays, hits), input.options.normals);

    std::vector<std::function<double()>> traces;
    traces.emplace_back([&] { return scene.run(*whole, rays.shadow); });
    const bool has_floor = scene.run_floor(*whole, rays.shadow).has_value();  // compiles
    if (has_floor) traces.emplace_back([&] { return *scene.run_floor(*whole, rays.shadow); });
    if (has_floor && cut) traces.emplace_back([&] { return *scene.run_floor(*cut, false); });
    const auto samples =
        interleave(traces, {.rounds = input.samples, .warm_up_ms = input.warm_up_ms, .seed = seed});
    const auto median = [&](size_t i) { return summarise(samples[i].device_ms, seed).median; };
    profile.trace_ms = median(0);
    if (has_floor) profile.floor_ms = median(1);
    if (has_floor && cut) profile.floor_at_hit_ms = median(2);

    profile.work = counted(scene, *whole, rays.shadow);
    if (cut) profile.work_at_hit = counted(scene, *cut, false);
    profile.shaders = scene.shader_statistics();
    return profile;
}

}  // namespace strandlab
