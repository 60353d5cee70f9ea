// A ray against a triangle, in the frame of the ray.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strandlab::oracle {

template <class Real>
struct TriangleHit {
    Real z = 0;
    std::array<Real, 3> weights{0, 0, 0};  // barycentric coordinates
};

/// The ray is the z axis: the origin of (x, y) against the three edges (Woop et al. 2013). Two-sided and
/// closed, with edges widened by their rounding error, so that no ray slips between two triangles.
template <class Real>
bool hit_triangle(const std::array<glm::vec<3, Real>, 3>& p, TriangleHit<Real>& hit) {
    Real positive = 0, negative = 0, sum = 0, noise = 0;
    std::array<Real, 3> area;
    for (int i = 0; i < 3; ++i) {
        const glm::vec<3, Real>&a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
        area[i] = a.x * b.y - a.y * b.x;
        noise =
            std::max(noise, std::max(std::abs(a.x), std::abs(a.y)) * std::max(std::abs(b.x), std::abs(b.y)));
        positive = std::max(positive, area[i]);
        negative = std::max(negative, -area[i]);
        sum += area[i];
    }
    noise *= 8 * std::numeric_limits<Real>::epsilon();
    if (!(std::min(positive, negative) <= noise) || sum == 0 || !(std::abs(sum) > noise)) return false;
    hit.z = 0;
    for (int i = 0; i < 3; ++i) {
        hit.weights[i] = area[i] / sum;
        hit.z += hit.weights[i] * p[i].z;
    }
    return true;
}

}  // namespace strandlab::oracle
