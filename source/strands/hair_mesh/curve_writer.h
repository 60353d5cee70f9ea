// Curves through the styled points of a strand.
#pragma once

#include "strands/hair_mesh/strand_kernel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace strandlab {

/// Curve k of the uniform Catmull-Rom curves through points[0], points[stride], ...
template <class Real>
auto catmull_rom_curve(const std::vector<glm::vec<4, Real>>& points, size_t stride, size_t k) {
    const size_t n = (points.size() - 1) / stride;
    const auto at = [&](size_t i) -> const glm::vec<4, Real>& { return points[i * stride]; };
    return kernels::HairStrandKernel<Real>::curve_between(at(k > 0 ? k - 1 : 0), at(k), at(k + 1),
                                                          at(std::min(k + 2, n)), k == 0, k + 1 == n);
}

/// The curves through all points; morphed towards those through every other point, which are split at their
/// middle for it: morph = 1 is the coarser strand exactly, so that a change of level is no jump (morphing the
/// points instead, as polylines allow, would be one).
template <class Real>
void write_points(const std::vector<glm::vec<4, Real>>& points, double morph,
                  std::array<glm::vec<4, Real>, 4>* out) {
    using Kernel = kernels::HairStrandKernel<Real>;
    const size_t n = points.size() - 1;
    const bool morphs = morph > 0 && n % 2 == 0;
    for (size_t k = 0; k < n; ++k) {
        auto record = catmull_rom_curve<Real>(points, 1, k);
        if (morphs)
            record =
                Kernel::morphed(record, catmull_rom_curve<Real>(points, 2, k / 2), k % 2 == 1, Real(morph));
        out[k] = {record.b0, record.b1, record.b2, record.b3};
    }
}

}  // namespace strandlab
