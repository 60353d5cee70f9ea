#include "trace/scene_oracle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"

#include <cmath>

namespace strandlab {
namespace {

/// World box of an object box, rounded outwards.
Box transformed(const Box& box, const glm::dmat3& linear, const glm::dvec3& translation) {
    Box result;
    if (box.is_empty()) return result;
    for (int axis = 0; axis < 3; ++axis) {
        double low = translation[axis], high = translation[axis], size = std::abs(translation[axis]);
        for (int k = 0; k < 3; ++k) {
            const double a = linear[k][axis] * double(box.low[k]), b = linear[k][axis] * double(box.high[k]);
            low += std::min(a, b);
            high += std::max(a, b);
            size += std::max(std::abs(a), std::abs(b));
        }
        const double margin = 1e-6 * size;
        result.low[axis] = static_cast<float>(low - margin);
        result.high[axis] = static_cast<float>(high + margin);
    }
    return result;
}

}  // namespace

SceneOracle::SceneOracle(std::span<const Surface> surfaces, std::span<const SurfaceInstance> instances,
                         const OracleOptions& options) {
    for (const Surface& surface : surfaces) oracles_.push_back(std::make_unique<Oracle>(surface, options));
    std::vector<Box> boxes;
    for (size_t i = 0; i < instances.size(); ++i) {
        const SurfaceInstance& instance = instances[i];
        if (instance.surface >= surfaces.size())
            fail(ExitCode::bad_input, "instance {}: names surface {}, there are {}", i, instance.surface,
                 surfaces.size());
        const glm::dmat4x3 transform(instance.transform);
        const glm::dmat3 linear(transform[0], transform[1], transform[2]);
        const double volume = glm::determinant(linear);
        if (!std::isfinite(volume) || volume == 0)
            fail(ExitCode::bad_input, "instance {}: transform with determinant {} cannot be inverted", i,
                 volume);
        const Oracle* oracle = oracles_[instance.surface].get();
        placed_.push_back(
            {oracle, glm::inverse(linear), transform[3], std::cbrt(std::abs(volume)), instance.first_curve});
        boxes.push_back(transformed(oracle->bounds(), linear, transform[3]));
    }
    bvh_ = Bvh(boxes);
}

ReferenceHit SceneOracle::trace(const Ray& ray) const {
    ReferenceHit best;
    if (!is_valid(ray)) return best;
    const glm::dvec3 origin(ray.origin), direction(ray.direction);
    bool starts_inside = false;
    bvh_.traverse(BvhRay(origin, direction, ray.tmin, ray.tmax), [&](uint32_t index, double& tmax) {
        const Placed& placed = placed_[index];
        const oracle::ExactRay local{placed.inverse * (origin - placed.translation),
                                     placed.inverse * direction, ray.tmin, tmax};
        ReferenceHit hit = placed.oracle->trace(local, placed.oracle->options());
        starts_inside = starts_inside || hit.starts_inside;
        if (!hit.is_hit() ||
            (best.is_hit() && !(hit.t < best.t || (hit.t == best.t && index < best.instance))))
            return false;
        hit.normal = glm::normalize(glm::transpose(placed.inverse) * hit.normal);
        hit.radius *= placed.scale;
        hit.curve += placed.first_curve;
        hit.instance = index;
        best = hit;
        tmax = hit.t;
        return false;
    });
    best.starts_inside = starts_inside;
    return best;
}

std::vector<ReferenceHit> SceneOracle::trace(std::span<const Ray> rays) const {
    std::vector<ReferenceHit> hits(rays.size());
    Progress progress("reference hits", rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        hits[i] = trace(rays[i]);
        progress.tick();
    });
    return hits;
}

}  // namespace strandlab
