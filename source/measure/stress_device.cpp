// Stress pairs on a Vulkan device.
#include "measure/stress.h"

namespace strandlab {
namespace {

/// Leaves of one structure: few enough that a ray meets few boxes of others, enough that builds are few.
constexpr uint64_t leaves_of_a_structure = 1024;

GpuScene make_scene(const Device& device, const Primitive& primitive, Geometry geometry,
                    const StressRange& range, const PairTracing& how) {
    SceneOptions options;
    options.compact = false;
    options.curves_of_a_ray = range.family->curves;
    options.max_leaves = leaves_of_a_structure;
    options.ray_extent = how.extent;
    options.pipelines = how.pipelines;
    options.arithmetic = how.arithmetic;
    options.no_skips = how.no_skips;
    std::vector<SceneModel> models;
    models.push_back({std::move(geometry), 0});
    const SceneInstance instance;
    return GpuScene(device, primitive, std::move(models), {&instance, 1}, options);
}

}  // namespace

PairScene::PairScene(const Device& device, const Primitive& primitive, Geometry geometry,
                     const StressRange& range, const PairTracing& how)
    : scene_(make_scene(device, primitive, std::move(geometry), range, how)) {}

std::vector<StressHit> PairScene::trace(std::span<const Ray> rays, bool shadow) const {
    Rays all;
    all.rays.assign(rays.begin(), rays.end());
    TraceOptions options;
    options.shadow = shadow;
    const TraceResult result = scene_.trace(all, options);
    std::vector<StressHit> hits(rays.size());
    for (size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = result.hits.hits[i];
        hits[i] = {double(hit.t), double(hit.u), hit.curve};
    }
    return hits;
}

}  // namespace strandlab
