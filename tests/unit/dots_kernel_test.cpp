// The triangle test of the C++ versions against an independent one.
#include "unit/support/dots_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strandlab::testing {
namespace {

/// Moeller and Trumbore 1997, in long double: an independent way to the same hit.
struct Expected {
    bool hit = false;
    long double t = 0, u = 0, margin = 0;  // margin: smallest distance of a barycentric from its bounds
};

Expected expected_hit(const SurfaceTriangle& triangle, const Ray& ray) {
    using V = glm::vec<3, long double>;
    const V a(triangle.vertex[0]), e1 = V(triangle.vertex[1]) - a, e2 = V(triangle.vertex[2]) - a;
    const V d(ray.direction), p = glm::cross(d, e2), s = V(ray.origin) - a, q = glm::cross(s, e1);
    const long double det = glm::dot(e1, p);
    if (det == 0) return {};
    const long double v = glm::dot(s, p) / det, w = glm::dot(d, q) / det, first = 1 - v - w;
    Expected expected;
    expected.t = glm::dot(e2, q) / det;
    expected.hit = v >= 0 && w >= 0 && first >= 0 && expected.t >= ray.tmin && expected.t < ray.tmax;
    expected.u = first * triangle.u[0] + v * triangle.u[1] + w * triangle.u[2];
    expected.margin = std::min({std::abs(v), std::abs(w), std::abs(first)});
    return expected;
}

template <class Real>
void expect_agreement(double distance, Real tolerance, Real t_tolerance) {
    const Curves curves = random_curves(3, 20, 2, 0.02);
    const PrimitiveChoice dots = dots_choice(":segments=2,width=projected");
    const Geometry geometry = dots.primitive->build(curves, dots.options);
    const Surface surface = dots.primitive->surface(curves, dots.options);
    size_t hits = 0, misses = 0;
    for (uint64_t trial = 0; trial < 40000; ++trial) {
        Random random(4, 0, trial);
        const size_t i = random.below(static_cast<uint32_t>(geometry.leaf_count()));
        const SurfaceTriangle& triangle = surface.triangles[i];
        const glm::vec3 target = (triangle.vertex[0] + triangle.vertex[1] + triangle.vertex[2]) / 3.0f;
        const Ray ray = ray_at(random, target, distance, 0.03);
        const Expected expected = expected_hit(triangle, ray);
        if (expected.margin < tolerance) continue;  // too close to an edge for a verdict
        LeafHit<Real> hit;
        const bool met = test_leaf(geometry, i, ray, hit);
        ASSERT_EQ(met, expected.hit) << trial;
        (met ? hits : misses) += 1;
        if (!met) continue;
        EXPECT_NEAR(double(hit.t), double(expected.t), double(t_tolerance) * double(expected.t));
        EXPECT_NEAR(double(hit.u), double(expected.u), double(tolerance));
        EXPECT_NEAR(double(glm::length(hit.normal)), 1, 1e-5);
        EXPECT_LE(double(glm::dot(hit.normal, glm::vec<3, Real>(ray.direction))), 1e-4);
    }
    EXPECT_GT(hits, 1000u);
    EXPECT_GT(misses, 1000u);
}

TEST(DotsKernel, FloatAgreesWithBruteForceNearAndFar) {
    expect_agreement<float>(3, 2e-3f, 1e-5f);
    expect_agreement<float>(1e4, 2e-3f, 1e-6f);
}

TEST(DotsKernel, DoubleAgreesWithBruteForce) {
    expect_agreement<double>(3, 1e-9, 1e-10);
    expect_agreement<double>(1e4, 1e-9, 1e-10);
}

TEST(DotsKernel, NoRaySlipsThroughTheDiagonalOfAQuad) {
    const Curves curves = random_curves(5, 4, 1, 0.05);
    const Geometry geometry = built_dots(curves, ":segments=1");
    for (uint64_t trial = 0; trial < 20000; ++trial) {
        Random random(6, 0, trial);
        const size_t quad = 2 * random.below(static_cast<uint32_t>(geometry.leaf_count() / 2));
        const glm::uvec3 corners = geometry.triangles[quad];
        const float share = static_cast<float>(random.range(0.05, 0.95));
        const glm::vec3 target =
            glm::mix(geometry.vertices[corners[1]], geometry.vertices[corners[2]], share);
        const Ray ray = ray_at(random, target, 2, 0);
        LeafHit<float> hit;
        EXPECT_TRUE(test_leaf(geometry, quad, ray, hit) || test_leaf(geometry, quad + 1, ray, hit)) << trial;
    }
}

}  // namespace
}  // namespace strandlab::testing
