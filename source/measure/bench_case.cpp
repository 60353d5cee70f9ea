#include "measure/bench_case.h"

#include "base/stopwatch.h"

#include <algorithm>
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

uint64_t HostGeometry::device_bytes() const {
    // Boxes, a structure before and after compaction, scratch: lavapipe keeps 88 bytes a box, NVIDIA 128 a
    // triangle.
    constexpr uint64_t bytes_per_leaf = 24 + 128 + 128 + 64;
    uint64_t bytes = 0;
    for (const SceneModel& model : models) {
        const Geometry& g = model.geometry;
        bytes += g.leaf_count() * (bytes_per_leaf + sizeof(Leaf)) +
                 g.vertices.size() * sizeof(g.vertices[0]) + g.leaf_records.bytes.size() +
                 g.curve_records.bytes.size() + g.shading_records.bytes.size();
    }
    return bytes;
}

HostGeometry make_geometry(const Scene& scene, const PrimitiveChoice& choice) {
    HostGeometry geometry{choice, {}, 0};
    const Stopwatch stopwatch;
    for (uint32_t i = 0; i < scene.models.size(); ++i)
        geometry.models.push_back(
            {choice.primitive->build(scene.models[i], choice.options), scene.first_curve(i)});
    geometry.milliseconds = stopwatch.milliseconds();
    return geometry;
}

PreparedCase prepare_case(const CaseInput& input, HostGeometry geometry) {
    PreparedCase prepared{geometry.choice, nullptr, geometry.milliseconds};
    SceneOptions options = input.options;
    if (input.culled != nullptr) options.curve_numbers = input.culled->curve_numbers;
    prepared.traced = input.device.prepare(*geometry.choice.primitive, std::move(geometry.models),
                                           input.scene.instances, options);
    return prepared;
}

PreparedCase prepare_case(const CaseInput& input, const PrimitiveChoice& choice) {
    return prepare_case(input, make_geometry(input.built(), choice));
}

std::vector<Surface> own_surfaces(const Scene& scene, const PrimitiveChoice& choice) {
    return surfaces_of(
        scene, [&](const Curves& curves) { return choice.primitive->surface(curves, choice.options); });
}

Comparison compare_with(const Scene& scene, const Curves& curves, const MeasuredRays& rays,
                        const Hits& sample_hits, const Reference& reference, bool against_curves,
                        const Reference* own) {
    std::vector<glm::mat4x3> transforms;
    if (!scene.is_plain())
        for (const SceneInstance& instance : scene.instances)
            transforms.push_back(instance.world_from_object);
    std::vector<uint8_t> inside_own(own != nullptr ? own->hits.size() : 0);
    for (size_t i = 0; i < inside_own.size(); ++i) inside_own[i] = own->hits[i].starts_inside;
    return compare({.rays = rays.sample_rays,
                    .hits = sample_hits.hits,
                    .normals = sample_hits.normals,
                    .reference = reference.hits,
                    .decisive = reference.decisive,
                    .decisive_place = reference.decisive_place,
                    .inside_own = inside_own,
                    .margin = reference.margin,
                    .curves = &curves,
                    .world_from_object = transforms,
                    .residual_of_curves = against_curves,
                    .hit_or_miss_only = rays.shadow});
}

CaseErrors errors_of(const CaseInput& input, const PrimitiveChoice& choice, const MeasuredRays& rays,
                     const Hits& sample_hits) {
    if (rays.sample.empty() || choice.primitive->diagnostic) return {};
    std::vector<Surface> surfaces = own_surfaces(input.scene, choice);
    // What is out of reach changes no answer; what is too small is no part of the surface.
    for (uint32_t i = 0; i < surfaces.size() && input.culled != nullptr; ++i)
        remove_too_small(surfaces[i], *input.culled, input.scene.first_curve(i));
    const Reference own = make_scene_reference(input.scene, surfaces, input.curves, rays.sample_rays);
    CaseErrors errors;
    errors.own = compare_with(input.scene, input.curves, rays, sample_hits, own, false);
    if (!rays.common.hits.empty())
        errors.model = compare_with(input.scene, input.curves, rays, sample_hits, rays.common, true, &own);
    return errors;
}

}  // namespace strandlab
