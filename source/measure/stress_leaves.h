// The leaves of single strands, and the nearest hit over them by the C++ versions, without any box.
#pragma once

#include "base/error.h"
#include "primitives/primitive.h"

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace strandlab {

/// The leaves of every strand, in ascending order.
class StrandLeaves {
  public:
    StrandLeaves(const Geometry& geometry, uint64_t strands, uint32_t curves)
        : first_(strands + 1, 0), leaves_(geometry.leaf_count()) {
        for (const Leaf& leaf : geometry.leaves) ++first_[leaf.curve / curves + 1];
        for (size_t i = 0; i < strands; ++i) first_[i + 1] += first_[i];
        std::vector<size_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < leaves_.size(); ++i) leaves_[next[geometry.leaves[i].curve / curves]++] = i;
    }
    std::span<const uint32_t> of(size_t strand) const {
        return std::span(leaves_).subspan(first_[strand], first_[strand + 1] - first_[strand]);
    }

  private:
    std::vector<size_t> first_;
    std::vector<uint32_t> leaves_;
};

/// Throws Error (usage) when the primitive has no C++ version.
inline void require_cpu_version(const Primitive& primitive) {
    if (primitive.cpu.single == nullptr || primitive.cpu.precise == nullptr)
        fail(ExitCode::usage, "primitive {}: has no C++ intersector; name another one", primitive.name);
}

template <class Real>
struct NearestHit {
    LeafHit<Real> hit;
    uint32_t leaf = no_curve;

    bool found() const { return leaf != no_curve; }
};

/// The nearest hit over some leaves, not finished; each(leaf, hit) is called for every leaf hit on the way.
template <class Real, class Each>
NearestHit<Real> nearest_hit(const CpuIntersectors& cpu, const Geometry& geometry,
                             std::span<const uint32_t> leaves, const Ray& ray, Each&& each) {
    NearestHit<Real> best;
    for (const uint32_t leaf : leaves) {
        LeafHit<Real> hit;
        const Real limit = best.found() ? best.hit.t : Real(ray.tmax);
        bool found = false;
        if constexpr (std::is_same_v<Real, float>)
            found = cpu.single(geometry, leaf, ray, limit, hit);
        else
            found = cpu.precise(geometry, leaf, ray, limit, hit);
        if (!found) continue;
        each(leaf, hit);
        best = {hit, leaf};
    }
    return best;
}

}  // namespace strandlab
