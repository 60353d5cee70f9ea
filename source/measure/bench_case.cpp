#include "measure/bench_case.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace strandlab {
namespace {

/// The hash of the anchor's samples, so that samples fall on no regular grid.
uint32_t scrambled(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7FEB352Du;
    x ^= x >> 15;
    x *= 0x846CA68Bu;
    return x ^ (x >> 16);
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::vector<uint32_t> error_sample(size_t ray_count, size_t wanted) {
    std::vector<uint32_t> indices;
    if (wanted == 0) return indices;
    const size_t stride = std::max<size_t>(1, ray_count / wanted);
    const size_t count = stride == 1 ? ray_count : ray_count / stride;
    indices.resize(count);
    for (uint32_t i = 0; i < count; ++i)
        indices[i] = static_cast<uint32_t>(i * stride + (stride == 1 ? 0 : scrambled(i) % stride));
    return indices;
}

std::vector<Ray> selected(const Rays& rays, const std::vector<uint32_t>& indices) {
    std::vector<Ray> some(indices.size());
    for (size_t i = 0; i < indices.size(); ++i) some[i] = rays.rays[indices[i]];
    return some;
}

Hits selected(const Hits& hits, const std::vector<uint32_t>& indices) {
    Hits some;
    some.hits.resize(indices.size());
    some.normals.resize(hits.normals.empty() ? 0 : indices.size());
    for (size_t i = 0; i < indices.size(); ++i) {
        some.hits[i] = hits.hits[indices[i]];
        if (!hits.normals.empty()) some.normals[i] = hits.normals[indices[i]];
    }
    return some;
}

PreparedCase prepare_case(const CaseInput& input, const PrimitiveChoice& choice) {
    PreparedCase prepared{choice, nullptr, {}, 0};
    const auto start = std::chrono::steady_clock::now();
    std::vector<SceneModel> models;
    for (uint32_t i = 0; i < input.scene.models.size(); ++i)
        models.push_back(
            {choice.primitive->build(input.scene.models[i], choice.options), input.scene.first_curve(i)});
    prepared.geometry_ms = milliseconds_since(start);
    prepared.traced =
        input.device.prepare(*choice.primitive, std::move(models), input.scene.instances, input.options);
    prepared.surfaces = surfaces_of(
        input.scene, [&](const Curves& curves) { return choice.primitive->surface(curves, choice.options); });
    return prepared;
}

Comparison compare_with(const Scene& scene, const Curves& curves, const MeasuredRays& rays,
                        const Hits& sample_hits, const Reference& reference, bool against_curves) {
    std::vector<glm::mat4x3> transforms;
    if (!scene.is_plain())
        for (const SceneInstance& instance : scene.instances)
            transforms.push_back(instance.world_from_object);
    return compare({.rays = rays.sample_rays,
                    .hits = sample_hits.hits,
                    .normals = sample_hits.normals,
                    .reference = reference.hits,
                    .decisive = reference.decisive,
                    .decisive_place = reference.decisive_place,
                    .margin = DecisiveMargin{}.radius,
                    .curves = &curves,
                    .world_from_object = transforms,
                    .residual_of_curves = against_curves,
                    .hit_or_miss_only = rays.shadow});
}

CaseResult run_case(const CaseInput& input, const PreparedCase& prepared, const MeasuredRays& rays) {
    TraceResult trace = prepared.traced->trace(
        rays.rays, {.shadow = rays.shadow, .samples = input.samples, .warm_up_ms = input.warm_up_ms});
    CaseResult result;
    result.trace_ms = std::move(trace.milliseconds);
    for (const Hit& hit : trace.hits.hits) result.hits += hit.is_hit() ? 1 : 0;
    if (rays.sample.empty() || prepared.choice.primitive->diagnostic) return result;
    const Hits sample = selected(trace.hits, rays.sample);
    const Reference own =
        make_scene_reference(input.scene, prepared.surfaces, input.curves, rays.sample_rays);
    result.own = compare_with(input.scene, input.curves, rays, sample, own, false);
    if (!rays.common.hits.empty())
        result.model = compare_with(input.scene, input.curves, rays, sample, rays.common, true);
    return result;
}

}  // namespace strandlab
