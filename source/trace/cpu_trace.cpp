#include "trace/cpu_trace.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace strandlab {

CpuTracer::CpuTracer(const Geometry& geometry, const Primitive& primitive, Precision precision, float extent)
    : geometry_(geometry), primitive_(primitive), precision_(precision) {
    const bool has_kernel =
        precision == Precision::single ? primitive.cpu.single != nullptr : primitive.cpu.precise != nullptr;
    if (!has_kernel)
        fail(ExitCode::usage, "primitive {}: has no C++ intersector of this precision; trace it on a device",
             primitive.name);
    std::vector<Box> boxes = leaf_boxes(geometry);
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(boxes[i], extent); });
    bvh_ = Bvh(boxes);
}

template <class Real, class Intersect, class Finish>
CpuTracer::Found<Real> CpuTracer::first(Intersect intersect, Finish finish, const Ray& ray,
                                        TraceMode mode) const {
    Found<Real> best;
    LeafHit<Real> hit;
    const BvhRay traversal(ray.origin, ray.direction, ray.tmin, ray.tmax);
    bvh_.traverse(traversal, [&](uint32_t leaf, double& tmax) {
        // A kernel accepts t < tmax only; one step more lets ties through, which the lower leaf wins.
        const bool has_hit = best.leaf != no_curve;
        const Real limit =
            has_hit ? std::nextafter(best.hit.t, std::numeric_limits<Real>::infinity()) : Real(ray.tmax);
        if (!intersect(geometry_, leaf, ray, limit, hit)) return false;
        if (has_hit && !(hit.t < best.hit.t || (hit.t == best.hit.t && leaf < best.leaf))) return false;
        best = {hit, leaf};
        tmax = double(hit.t);
        return mode == TraceMode::any;
    });
    if (finish && best.leaf != no_curve) finish(geometry_, best.leaf, ray, best.hit);
    return best;
}

Hit CpuTracer::trace(const Ray& ray, TraceMode mode, glm::vec3* normal) const {
    if (normal) *normal = glm::vec3(0);
    if (!is_valid(ray)) return {};
    const auto result = [&](const auto& found) -> Hit {
        if (found.leaf == no_curve) return {};
        if (normal) *normal = glm::vec3(found.hit.normal);
        return {static_cast<float>(found.hit.t), static_cast<float>(found.hit.u),
                geometry_.leaves[found.leaf].curve, 0};
    };
    const CpuIntersectors& cpu = primitive_.cpu;
    return precision_ == Precision::single
               ? result(first<float>(cpu.single, cpu.finish_single, ray, mode))
               : result(first<double>(cpu.precise, cpu.finish_precise, ray, mode));
}

RayWork CpuTracer::work(const Ray& ray, TraceMode mode) const {
    RayWork work;
    if (primitive_.cpu.single == nullptr || !is_valid(ray)) return work;
    const auto counted = [&](const Geometry& geometry, size_t leaf, const Ray& r, float tmax,
                             LeafHit<float>& hit) {
        uint32_t iterations = 0;
        const bool found = primitive_.cpu.counted != nullptr
                               ? primitive_.cpu.counted(geometry, leaf, r, tmax, hit, iterations)
                               : primitive_.cpu.single(geometry, leaf, r, tmax, hit);
        ++work.leaves;
        work.searched += iterations > 0 ? 1 : 0;
        work.iterations += iterations;
        work.reports += found ? 1 : 0;
        return found;
    };
    first<float>(counted, primitive_.cpu.finish_single, ray, mode);
    return work;
}

uint32_t CpuTracer::walk(const Ray& ray) const {
    uint32_t leaves = 0;
    if (!is_valid(ray)) return leaves;
    bvh_.traverse(BvhRay(ray.origin, ray.direction, ray.tmin, ray.tmax), [&](uint32_t, double&) {
        ++leaves;
        return false;
    });
    return leaves;
}

ReferenceHit CpuTracer::trace_unrounded(const Ray& ray) const {
    ReferenceHit result;
    if (!is_valid(ray)) return result;
    const auto fill = [&](const auto& found) {
        if (found.leaf == no_curve) return;
        result.t = double(found.hit.t);
        result.u = double(found.hit.u);
        result.normal = glm::dvec3(found.hit.normal);
        result.curve = geometry_.leaves[found.leaf].curve;
    };
    const CpuIntersectors& cpu = primitive_.cpu;
    if (precision_ == Precision::single)
        fill(first<float>(cpu.single, cpu.finish_single, ray, TraceMode::closest));
    else
        fill(first<double>(cpu.precise, cpu.finish_precise, ray, TraceMode::closest));
    return result;
}

std::vector<ReferenceHit> cpu_trace_precise(const Geometry& geometry, const Primitive& primitive,
                                            std::span<const Ray> rays) {
    const CpuTracer tracer(geometry, primitive, Precision::precise, extent_of(rays));
    std::vector<ReferenceHit> hits(rays.size());
    parallel_for(rays.size(), [&](size_t i) { hits[i] = tracer.trace_unrounded(rays[i]); });
    return hits;
}

std::vector<RayWork> cpu_work(const Geometry& geometry, const Primitive& primitive,
                              std::span<const Ray> rays) {
    const CpuTracer tracer(geometry, primitive, Precision::single, extent_of(rays));
    std::vector<RayWork> work(rays.size());
    parallel_for(rays.size(), [&](size_t i) { work[i] = tracer.work(rays[i]); });
    return work;
}

Hits cpu_trace(const Geometry& geometry, const Primitive& primitive, std::span<const Ray> rays,
               Precision precision, TraceMode mode, bool wants_normals) {
    const CpuTracer tracer(geometry, primitive, precision, extent_of(rays));
    Hits result;
    result.hits.resize(rays.size());
    if (wants_normals) result.normals.resize(rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        result.hits[i] = tracer.trace(rays[i], mode, wants_normals ? &result.normals[i] : nullptr);
    });
    return result;
}

}  // namespace strandlab
