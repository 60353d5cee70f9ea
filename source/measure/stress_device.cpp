// Stress pairs on a Vulkan device.
#include "measure/stress.h"

#include <algorithm>

namespace strandlab {
namespace {

/// Leaves of one structure: few enough that a ray meets few boxes of others, enough that builds are few.
constexpr uint64_t leaves_of_a_structure = 1024;

}  // namespace

std::vector<StressHit> trace_pairs(const Device& device, const Primitive& primitive, Geometry geometry,
                                   const StressPairs& pairs) {
    SceneOptions options;
    options.compact = false;
    options.curves_of_a_ray = pairs.range.family->curves;
    options.max_leaves = leaves_of_a_structure;
    Rays rays;
    rays.rays = pairs.rays;
    options.ray_extent = extent_of(rays);
    std::vector<SceneModel> models;
    models.push_back({std::move(geometry), 0});
    const SceneInstance instance;
    const GpuScene scene(device, primitive, std::move(models), {&instance, 1}, options);
    const TraceResult result = scene.trace(rays);
    std::vector<StressHit> hits(rays.rays.size());
    for (size_t i = 0; i < hits.size(); ++i)
        hits[i] = {double(result.hits.hits[i].t), result.hits.hits[i].is_hit()};
    return hits;
}

}  // namespace strandlab
