// Boxes, and the tight boxes of swept spheres.
#pragma once

#include "strands/curves.h"

#include <glm/glm.hpp>

#include <limits>

namespace strandlab {

/// An axis-aligned box; empty until something is added. Layout as Vulkan's VkAabbPositionsKHR.
struct Box {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};

    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool is_empty() const { return !(low.x <= high.x); }
};
static_assert(sizeof(Box) == 24);

/// The tight box of the balls of radius r(u) around C(u), u in [a, b]: exact extrema of the cubics
/// P_i -+ r in double, rounded outwards to float (intersectors.md section 7). It also holds the
/// swept discs.
Box bounds_of(const Curve& curve, double a = 0.0, double b = 1.0);

/// Box of the round cone between two (x, y, z, radius) ends: both end spheres.
Box bounds_of(const glm::vec4& start, const glm::vec4& end);

/// Moves every face outwards by 4 ulp of (largest coordinate of the box + extent), because the slab
/// tests of drivers are not conservative; extent is the largest coordinate of any ray origin.
Box padded(const Box& box, float extent);

}  // namespace strandlab
