// One bundle of a hair mesh while strands grow in it.
#pragma once

#include "strands/hair_mesh/columns.h"
#include "strands/hair_mesh/strand_kernel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace strandlab {

/// Columns in the precision of the kernel.
template <class Real>
struct ColumnNumbers {
    using Vec3 = glm::vec<3, Real>;
    uint32_t layers = 0;
    std::vector<Vec3> controls, u, v;
    std::vector<Real> w;
    std::vector<glm::vec<2, Real>> uv;  // of every vertex, metres

    ColumnNumbers(const HairMesh& mesh, const HairMeshColumns& columns) : layers(columns.layers) {
        const auto convert = [](const std::vector<glm::dvec3>& from, std::vector<Vec3>& to) {
            to.assign(from.begin(), from.end());
        };
        convert(columns.controls, controls);
        convert(columns.u, u);
        convert(columns.v, v);
        w.assign(columns.w.begin(), columns.w.end());
        for (const glm::dvec2& p : mesh.uv) uv.emplace_back(mesh.unit() * p);
    }
};

/// The columns of a bundle, blended for one strand.
template <class Real>
class BlendedColumn {
  public:
    using Kernel = kernels::HairStrandKernel<Real>;
    using Vec3 = glm::vec<3, Real>;
    using Vec4 = glm::vec<4, Real>;

    /// The centre line alone.
    void blend_controls(const ColumnNumbers<Real>& columns, const HairMeshFace& face, const Vec4& weights) {
        blend_all(columns.controls, size_t(3) * columns.layers + 1, face, weights, controls);
    }

    void blend_all_of(const ColumnNumbers<Real>& columns, const HairMeshFace& face, const Vec4& weights) {
        blend_controls(columns, face, weights);
        const size_t points = size_t(columns.layers) + 1;
        blend_all(columns.u, points, face, weights, u);
        blend_all(columns.v, points, face, weights, v);
        w.resize(points);
        const auto corners = corners_of(face);
        for (size_t l = 0; l < points; ++l) {
            const auto at = [&](int k) { return columns.w[corners[k] * points + l]; };
            const Real first = at(0) * weights.x + at(1) * weights.y,
                       second = at(2) * weights.z + at(3) * weights.w;
            w[l] = first + second;
        }
        const auto at = [&](int k) { return Vec3(columns.uv[corners[k]], Real(0)); };
        root_uv = Kernel::blend(at(0), at(1), at(2), at(3), weights);
    }

    /// Point at the fraction s of a layer.
    Vec3 point(size_t layer, Real s) const {
        const Vec3* b = &controls[3 * layer];
        return Kernel::cubic_point(b[0], b[1], b[2], b[3], s);
    }

    std::vector<Vec3> controls, u, v;
    std::vector<Real> w;
    Vec3 root_uv{0};

  private:
    /// A triangle's fourth corner has weight 0 and stands for its first.
    static std::array<size_t, 4> corners_of(const HairMeshFace& face) {
        return {face.vertex[0], face.vertex[1], face.vertex[2],
                face.is_triangle() ? face.vertex[0] : face.vertex[3]};
    }

    static void blend_all(const std::vector<Vec3>& from, size_t count, const HairMeshFace& face,
                          const Vec4& weights, std::vector<Vec3>& to) {
        to.resize(count);
        const auto corners = corners_of(face);
        const Vec3 *a = &from[corners[0] * count], *b = &from[corners[1] * count],
                   *c = &from[corners[2] * count], *d = &from[corners[3] * count];
        for (size_t i = 0; i < count; ++i) to[i] = Kernel::blend(a[i], b[i], c[i], d[i], weights);
    }
};

/// Noise along a strand: the two planes around a place, made anew only when it enters another cell.
template <class Real, class MakePlane>
class NoiseAlong {
  public:
    using Kernel = kernels::HairStrandKernel<Real>;

    explicit NoiseAlong(MakePlane make) : make_(make) {}

    glm::vec<2, Real> at(Real x) {
        const int k = Kernel::floor_of(x);
        if (!known_ || k != cell_) {
            below_ = known_ && k == cell_ + 1 ? above_ : make_(k);
            above_ = make_(k + 1);
            cell_ = k;
            known_ = true;
        }
        return Kernel::noise_between(below_, above_, x - Real(k));
    }

  private:
    MakePlane make_;
    bool known_ = false;
    int cell_ = 0;
    glm::vec<4, Real> below_{0}, above_{0};
};

}  // namespace strandlab
