// A small bounding volume hierarchy for references on the CPU: float boxes, traversal in double.
#pragma once

#include "scene/bounds.h"

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace strandlab {

/// A ray in double precision, as the traversal needs it: closed interval [tmin, tmax], tmin >= 0.
struct BvhRay {
    glm::dvec3 origin, inv_direction;
    double tmin, tmax;

    BvhRay(const glm::dvec3& o, const glm::dvec3& d, double t0, double t1) : origin(o), tmin(t0), tmax(t1) {
        // A component of zero: the slab holds either every t or none. 1e300 avoids 0 * infinity.
        for (int i = 0; i < 3; ++i) inv_direction[i] = d[i] == 0 ? 1e300 : 1 / d[i];
    }
};

/// Binary hierarchy over boxes. Built in parallel with binned surface areas; the result does not depend
/// on the number of threads. Items whose boxes are empty or not finite are left out.
class Bvh {
  public:
    Bvh() = default;
    explicit Bvh(std::span<const Box> boxes);

    /// Calls visit(item, tmax) for the items of all leaves whose boxes the ray meets within [tmin, tmax],
    /// nearer children first. visit may lower tmax (a double&); when it returns true, traversal ends.
    /// The slab test errs on the side of visiting.
    template <class Visit>
    void traverse(const BvhRay& ray, Visit&& visit) const;

    /// Box of everything.
    Box bounds() const { return nodes_.empty() ? Box{} : nodes_[0].box; }
    size_t item_count() const { return items_.size(); }
    size_t bytes() const { return nodes_.size() * sizeof(Node) + items_.size() * sizeof(uint32_t); }

  private:
    /// Leaf: items_[first, first + count). Inner node: count = 0, children at index + 1 and first.
    struct Node {
        Box box;
        uint32_t first = 0, count = 0;
    };
    struct Builder;

    /// Depth of the builder's tree is bounded by this (it falls back to halving by count).
    static constexpr int max_depth = 96;

    static bool meets(const Box& box, const BvhRay& ray, double tmax, double& entry);

    std::vector<Node> nodes_;
    std::vector<uint32_t> items_;
};

inline bool Bvh::meets(const Box& box, const BvhRay& ray, double tmax, double& entry) {
    // Each plane parameter carries a relative error of three roundings; the factor below covers both sides
    // (Ize 2013, "Robust BVH ray traversal").
    constexpr double slack = 1 + 8 * std::numeric_limits<double>::epsilon();
    double near = ray.tmin, far = tmax;
    for (int i = 0; i < 3; ++i) {
        const double t0 = (double(box.low[i]) - ray.origin[i]) * ray.inv_direction[i];
        const double t1 = (double(box.high[i]) - ray.origin[i]) * ray.inv_direction[i];
        const double low = t0 < t1 ? t0 : t1, high = t0 < t1 ? t1 : t0;
        if (low > near) near = low;
        if (high * slack < far) far = high * slack;
    }
    entry = near;
    return near <= far * slack;
}

template <class Visit>
void Bvh::traverse(const BvhRay& ray, Visit&& visit) const {
    if (nodes_.empty()) return;
    double tmax = ray.tmax, entry = 0;
    if (!meets(nodes_[0].box, ray, tmax, entry)) return;
    std::pair<uint32_t, double> stack[max_depth + 1];
    int size = 0;
    uint32_t index = 0;
    while (true) {
        const Node& node = nodes_[index];
        bool descend = false;
        if (node.count > 0) {
            for (uint32_t i = 0; i < node.count; ++i)
                if (visit(items_[node.first + i], tmax)) return;
        } else {
            uint32_t left = index + 1, right = node.first;
            double left_entry = 0, right_entry = 0;
            const bool meets_left = meets(nodes_[left].box, ray, tmax, left_entry);
            const bool meets_right = meets(nodes_[right].box, ray, tmax, right_entry);
            if (meets_left && meets_right) {
                if (right_entry < left_entry) {
                    std::swap(left, right);
                    std::swap(left_entry, right_entry);
                }
                stack[size++] = {right, right_entry};
            }
            descend = meets_left || meets_right;
            index = meets_left || !meets_right ? left : right;
        }
        if (descend) continue;
        while (size > 0 && !(stack[size - 1].second <= tmax)) --size;
        if (size == 0) return;
        index = stack[--size].first;
    }
}

}  // namespace strandlab
