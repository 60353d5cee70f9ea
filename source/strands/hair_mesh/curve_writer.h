// Curves through the styled points of a strand.
#pragma once

#include "strands/hair_mesh/strand_kernel.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace strandlab {

/// The uniform Catmull-Rom curves through points[0], points[stride], ... : their number less one.
template <class Real>
void catmull_rom_curves(const std::vector<glm::vec<4, Real>>& points, size_t stride,
                        std::array<glm::vec<4, Real>, 4>* out) {
    using Kernel = kernels::HairStrandKernel<Real>;
    using Vec4 = glm::vec<4, Real>;
    const size_t n = (points.size() - 1) / stride;
    const auto at = [&](size_t k) -> const Vec4& { return points[k * stride]; };
    // A third of the derivative at every point.
    const auto step = [&](size_t k) -> Vec4 {
        if (n == 1) return (at(1) - at(0)) * Real(1.0 / 3);
        if (k == 0) return Kernel::end_step(at(0), at(1), at(2));
        if (k == n) return -Kernel::end_step(at(n), at(n - 1), at(n - 2));
        return Kernel::inner_step(at(k - 1), at(k + 1));
    };
    Vec4 before = step(0);
    for (size_t k = 0; k < n; ++k) {
        const Vec4 after = step(k + 1);
        out[k] = {at(k), at(k) + before, at(k + 1) - after, at(k + 1)};
        for (Vec4& b : out[k]) b.w = b.w > 0 ? b.w : Real(0);
        before = after;
    }
}

/// The same, control points morphed towards the curves through every other point, which are split at their
/// middle for it: morph = 1 is the coarser strand exactly, so that a change of level is no jump (morphing the
/// points instead, as polylines allow, would be one). scratch is memory to use.
template <class Real>
void write_points(const std::vector<glm::vec<4, Real>>& points, double morph,
                  std::array<glm::vec<4, Real>, 4>* out,
                  std::vector<std::array<glm::vec<4, Real>, 4>>& scratch) {
    using Vec4 = glm::vec<4, Real>;
    catmull_rom_curves(points, 1, out);
    const size_t n = points.size() - 1;
    if (!(morph > 0) || n % 2 != 0) return;
    scratch.resize(n / 2);
    catmull_rom_curves(points, 2, scratch.data());
    const Real g = Real(morph), half = Real(0.5);
    for (size_t k = 0; k < n; ++k) {
        const auto& c = scratch[k / 2];
        const Vec4 ab = (c[0] + c[1]) * half, bc = (c[1] + c[2]) * half, cd = (c[2] + c[3]) * half;
        const Vec4 abc = (ab + bc) * half, bcd = (bc + cd) * half, middle = (abc + bcd) * half;
        const std::array<Vec4, 4> part = k % 2 == 0 ? std::array<Vec4, 4>{c[0], ab, abc, middle}
                                                    : std::array<Vec4, 4>{middle, bcd, cd, c[3]};
        for (int i = 0; i < 4; ++i) out[k][i] += g * (part[i] - out[k][i]);
    }
}

}  // namespace strandlab
