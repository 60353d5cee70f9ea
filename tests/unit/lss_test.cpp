// The closed form of round cones: float against double where the two are hardest to keep together.
#include "base/random.h"
#include "primitives/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace kernels {

template <class real>
struct RoundConeKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/piece_test.h"
#include "shaders/shared/ray_frame.h"
#include "shaders/primitives/lss.h"
};

}  // namespace kernels

namespace {

struct Cone {
    glm::vec4 start, end;
};

/// Whether the ray meets the cone whose radii are scaled.
template <class Real>
bool meets(const Cone& cone, glm::vec3 origin, glm::vec3 direction, double scale, Real& t) {
    using Vec3 = glm::vec<3, Real>;
    using Vec4 = glm::vec<4, Real>;
    const Vec4 start(Vec3(cone.start), Real(cone.start.w * scale)),
        end(Vec3(cone.end), Real(cone.end.w * scale));
    Real u;
    Vec3 normal;
    return kernels::RoundConeKernel<Real>::lss_intersect(Vec3(origin), Vec3(direction), Real(0), Real(1e30),
                                                         start, end, 0, 1, false, false, true, t, u, normal);
}

/// Of rays that cross a thin cone at 1e-7 to 1e-1 radians from its axis, all that radii scaled by 1 -+ 1e-3
/// do not change. The entry's depth before the centre of its ball is then a small part of the radius.
TEST(Lss, RaysNearlyAlongACone) {
    int hits = 0, misses = 0, wrong = 0;
    for (uint64_t i = 0; i < 200'000; ++i) {
        Random random(7, 0, i);
        const glm::dvec3 axis =
            glm::normalize(glm::dvec3(random.signed_unit(), random.signed_unit(), random.signed_unit()));
        const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.3, -0.5, 0.81)));
        const glm::dvec3 third = glm::cross(axis, across);
        const double length = 0.25, radius = length * std::pow(10.0, random.range(-5, -1));
        const double angle = std::pow(10.0, random.range(-7, -1));
        const glm::dvec3 centre(random.signed_unit(), random.signed_unit(), random.signed_unit());
        const Cone cone{
            glm::vec4(centre - axis * (length / 2), radius),
            glm::vec4(centre + axis * (length / 2), radius * random.range(0.8, 1.2)),
        };
        // The ray's point nearest to the axis lies anywhere along it, up to 1.2 radii beside.
        const glm::dvec3 direction = axis * std::cos(angle) + across * std::sin(angle);
        const glm::dvec3 target = centre + axis * (length / 2 * random.signed_unit()) +
                                  third * (radius * 1.2 * random.signed_unit());
        const glm::vec3 ray(direction), origin(target - direction * random.range(1, 10));
        const double margin = std::max(1e-3, 1e-6 / radius);  // eight roundings of a coordinate
        double less, more;
        const bool inner = meets(cone, origin, ray, 1 - margin, less);
        const bool outer = meets(cone, origin, ray, 1 + margin, more);
        if (inner != outer) continue;
        float t;
        const bool found = meets(cone, origin, ray, 1, t);
        (inner ? hits : misses)++;
        if (found != inner) ++wrong;
        if (!found || !inner) continue;
        EXPECT_LT(t, less + 1e-5);
        EXPECT_GT(t, more - 1e-5);
    }
    EXPECT_GT(hits, 50'000);
    EXPECT_GT(misses, 10'000);
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace strandlab
