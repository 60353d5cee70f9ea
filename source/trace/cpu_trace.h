// Whole scenes through the C++ versions of the primitives' own intersectors.
#pragma once

#include "primitives/primitive.h"
#include "scene/geometry.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "trace/bvh.h"
#include "trace/work_counts.h"

#include <span>
#include <vector>

namespace strandlab {

/// single: what the GPU computes; precise: the same text in double.
enum class Precision { single, precise };

/// closest: the nearest hit; any: the first hit that traversal comes upon (shadow rays).
enum class TraceMode { closest, any };

/// One geometry with its hierarchy, traced by a primitive's C++ kernel, which also finishes the hit that
/// traversal ends with, as the closest-hit shader does. The boxes are padded as a GPU
/// builder pads them, for ray origins up to `extent` from the world's origin.
class CpuTracer {
  public:
    /// Keeps references to geometry and primitive. Throws Error (usage) when the primitive has no C++
    /// kernel of that precision.
    CpuTracer(const Geometry& geometry, const Primitive& primitive, Precision precision, float extent);

    /// Result of one ray; its normal, if asked for, is zero for a miss. Hits with the same t go to the lower
    /// leaf. Invalid rays miss.
    Hit trace(const Ray& ray, TraceMode mode = TraceMode::closest, glm::vec3* normal = nullptr) const;

    /// What the float kernel's trace takes; no iterations for closed forms.
    RayWork work(const Ray& ray, TraceMode mode = TraceMode::closest) const;

    /// Leaves that the traversal comes upon when nothing is ever hit.
    uint32_t walk(const Ray& ray) const;

    /// The same, not rounded to float: t, u, normal and curve of the closest hit.
    ReferenceHit trace_unrounded(const Ray& ray) const;

  private:
    template <class Real>
    struct Found {
        LeafHit<Real> hit;
        uint32_t leaf = no_curve;  // no_curve: a miss
    };
    template <class Real, class Intersect, class Finish>
    Found<Real> first(Intersect intersect, Finish finish, const Ray& ray, TraceMode mode) const;

    const Geometry& geometry_;
    const Primitive& primitive_;
    Precision precision_;
    Bvh bvh_;
};

/// All rays, in parallel, with the double-precision kernel and its results as they are: against the oracle,
/// this is the error of the algorithm apart from that of rounding. Radius, caps and starts_inside are not
/// filled in.
std::vector<ReferenceHit> cpu_trace_precise(const Geometry& geometry, const Primitive& primitive,
                                            std::span<const Ray> rays);

/// What the float kernel takes for each ray, in parallel.
std::vector<RayWork> cpu_work(const Geometry& geometry, const Primitive& primitive,
                              std::span<const Ray> rays);

/// All rays, in parallel; normals only when wanted.
Hits cpu_trace(const Geometry& geometry, const Primitive& primitive, std::span<const Ray> rays,
               Precision precision, TraceMode mode = TraceMode::closest, bool wants_normals = false);

}  // namespace strandlab
