#include "trace/cpu_trace.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace strandlab {

CpuTracer::CpuTracer(const Geometry& geometry, const Primitive& primitive, Precision precision, float extent)
    : geometry_(geometry), primitive_(primitive), precision_(precision) {
    const bool has_kernel = precision == Precision::single ? primitive.cpu.single != nullptr
                                                           : primitive.cpu.precise != nullptr;
    if (!has_kernel)
        fail(ExitCode::usage, "primitive {}: has no C++ intersector of this precision; trace it on a device",
             primitive.name);
    std::vector<Box> boxes = leaf_boxes(geometry);
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(boxes[i], extent); });
    bvh_ = Bvh(boxes);
}

template <class Real, class Intersect>
Hit CpuTracer::trace_with(Intersect intersect, const Ray& ray, TraceMode mode, glm::vec3* normal) const {
    LeafHit<Real> best, hit;
    uint32_t best_leaf = no_curve;
    const BvhRay traversal(ray.origin, ray.direction, ray.tmin, ray.tmax);
    bvh_.traverse(traversal, [&](uint32_t leaf, double& tmax) {
        // A kernel accepts t < tmax only; one step more lets ties through, which the lower leaf wins.
        const Real limit = best_leaf == no_curve
                               ? Real(ray.tmax)
                               : std::nextafter(best.t, std::numeric_limits<Real>::infinity());
        if (!intersect(geometry_, leaf, ray, limit, hit)) return false;
        if (best_leaf != no_curve && !(hit.t < best.t || (hit.t == best.t && leaf < best_leaf))) return false;
        best = hit;
        best_leaf = leaf;
        tmax = double(hit.t);
        return mode == TraceMode::any;
    });
    if (best_leaf == no_curve) return {};
    if (normal) *normal = glm::vec3(best.normal);
    return {static_cast<float>(best.t), static_cast<float>(best.u), geometry_.leaves[best_leaf].curve, 0};
}

Hit CpuTracer::trace(const Ray& ray, TraceMode mode, glm::vec3* normal) const {
    if (normal) *normal = glm::vec3(0);
    if (!is_valid(ray)) return {};
    return precision_ == Precision::single ? trace_with<float>(primitive_.cpu.single, ray, mode, normal)
                                           : trace_with<double>(primitive_.cpu.precise, ray, mode, normal);
}

Hits cpu_trace(const Geometry& geometry, const Primitive& primitive, std::span<const Ray> rays, Precision precision,
               TraceMode mode, bool wants_normals) {
    float extent = 0;
    for (const Ray& ray : rays)
        if (is_valid(ray))
            extent = std::max({extent, std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)});
    const CpuTracer tracer(geometry, primitive, precision, extent);
    Hits result;
    result.hits.resize(rays.size());
    if (wants_normals) result.normals.resize(rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        result.hits[i] = tracer.trace(rays[i], mode, wants_normals ? &result.normals[i] : nullptr);
    });
    return result;
}

}  // namespace strandlab
