#include "primitives/dots.h"

#include "base/random.h"
#include "primitives/strand_frames.h"
#include "strands/bezier.h"
#include "unit/support/dots_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace strandlab::testing {
namespace {

TEST(Dots, FourTrianglesAPieceAndFourVerticesAJoint) {
    const Curves curves = random_curves(1, 7, 3, 0.01);
    const Geometry geometry = built_dots(curves, ":segments=5");
    EXPECT_EQ(geometry.triangles.size(), 7u * 3 * 5 * 4);
    EXPECT_EQ(geometry.vertices.size(), 7u * (3 * 5 + 1) * 4);
    ASSERT_EQ(geometry.leaves.size(), geometry.triangles.size());
    size_t begins = 0, ends = 0;
    for (size_t i = 0; i < geometry.leaves.size(); ++i) {
        const Leaf leaf = geometry.leaves[i];
        EXPECT_EQ(leaf.curve, i / 20);
        EXPECT_EQ(leaf.piece(), i / 4 % 5);
        EXPECT_EQ(leaf.pieces(), 5u);
        EXPECT_EQ((leaf.flags() & dots_quad_bit) != 0, i % 4 >= 2);
        EXPECT_EQ((leaf.flags() & dots_triangle_bit) != 0, i % 2 == 1);
        begins += leaf.flags() & Leaf::begins_strand;
        ends += (leaf.flags() & Leaf::ends_strand) / 2;
    }
    EXPECT_EQ(begins, 7u * 4);
    EXPECT_EQ(ends, 7u * 4);
}

TEST(Dots, CurvesThatDoNotMeetGetTheirOwnJoints) {
    Curves curves;
    curves.curves = {line({0, 0, 0, 0.1f}, {1, 0, 0, 0.1f}), line({1, 0, 0, 0.2f}, {2, 0, 0, 0.2f}),
                     line({2, 0, 0, 0.2f}, {3, 0, 0, 0.1f})};
    curves.strands = {{0, 3}};
    const Geometry geometry = built_dots(curves, ":segments=2");
    EXPECT_EQ(geometry.vertices.size(), 4u * (3 + 5));
    for (size_t i = 0; i < geometry.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const float x = geometry.vertices[geometry.triangles[i][k]].x;
            EXPECT_GE(x, float(geometry.leaves[i].curve) - 1e-6f);
            EXPECT_LE(x, float(geometry.leaves[i].curve) + 1 + 1e-6f);
        }
}

TEST(Dots, StripsAreAsWideAsAskedFor) {
    const Curves curves = random_curves(2, 5, 2, 0.01);
    for (const auto& [option, factor] :
         {std::pair(":segments=3", 1.0), std::pair(":segments=3,width=projected", projected_half_width)}) {
        const Surface surface = parse_primitive(std::string("dots") + option)
                                    .primitive->surface(curves, dots_choice(option).options);
        for (const SurfaceTriangle& triangle : surface.triangles)
            for (int k = 0; k < 3; ++k) {
                const glm::dvec4 point = point_at(to_double(curves.curves[triangle.curve]), triangle.u[k]);
                EXPECT_NEAR(glm::distance(glm::dvec3(triangle.centre[k]), glm::dvec3(point)), 0, 1e-6);
                EXPECT_NEAR(glm::distance(glm::dvec3(triangle.vertex[k]), glm::dvec3(point)),
                            factor * point.w, 1e-6);
            }
    }
}

TEST(Dots, ProjectedWidthIsTheDiameterInTheMean) {
    double mean = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / n;
        mean += projected_half_width * std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle))) / n;
    }
    EXPECT_NEAR(mean, 1, 1e-8);
}

TEST(Dots, RollsStrandsApartUnlessFixed) {
    Curves curves;
    for (uint32_t s = 0; s < 50; ++s) {
        curves.curves.push_back(line({s, 0, 0, 0.1f}, {s, 0, 1, 0.1f}));
        curves.strands.push_back({s, 1});
    }
    const auto directions = [&](const std::string& options) {
        std::vector<float> angles;
        const Geometry geometry = built_dots(curves, options);
        for (uint32_t s = 0; s < 50; ++s) {
            const glm::vec3 axis = geometry.vertices[8 * 4 * s + 1] - geometry.vertices[8 * 4 * s];
            angles.push_back(std::atan2(axis.y, axis.x));
        }
        std::sort(angles.begin(), angles.end());
        return angles.back() - angles.front();
    };
    EXPECT_LT(directions(":segments=7,roll=fixed"), 1e-4);
    EXPECT_GT(directions(":segments=7"), 1.0);
}

/// A straight strand along z with radius 0.5 and fixed strips; rays from +x.
struct StraightStrand {
    Curves curves;
    StraightStrand() {
        curves.curves = {line({0, 0, 0, 0.5f}, {0, 0, 4, 0.5f})};
        curves.strands = {{0, 1}};
    }
    /// The nearest hit among all leaves.
    LeafHit<double> nearest(const std::string& options, const Ray& ray) const {
        const Geometry geometry = built_dots(curves, options);
        LeafHit<double> best;
        best.t = 1e30;
        size_t leaf = geometry.leaf_count();
        for (size_t i = 0; i < geometry.leaf_count(); ++i) {
            LeafHit<double> hit;
            if (test_leaf(geometry, i, ray, hit) && hit.t < best.t) best = hit, leaf = i;
        }
        if (leaf < geometry.leaf_count())
            primitive_named("dots").cpu.finish_precise(geometry, leaf, ray, best);
        return best;
    }
};

Ray ray_towards(const glm::vec3& origin, const glm::vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

TEST(Dots, RoundNormalAndOffsetAreThoseOfTheCylinder) {
    const StraightStrand strand;
    for (const float y : {-0.45f, -0.2f, 0.0f, 0.1f, 0.45f})
        for (const float z : {1.2f, 2.5f}) {
            for (const glm::vec3 direction : {glm::vec3(-1, 0, 0), glm::vec3(-2, 0, 0.2f)}) {
                const Ray ray = ray_towards({3, y, z}, direction);
                const double depth = std::sqrt(0.25 - double(y) * y);
                const LeafHit<double> moved =
                    strand.nearest(":segments=2,width=projected,roll=fixed,offset=round", ray);
                ASSERT_LT(moved.t, 1e29);
                EXPECT_NEAR(moved.t, (3 - depth) / -direction.x, 1e-6);
                EXPECT_NEAR(moved.u, (z + direction.z * moved.t) / 4, 1e-6);
                EXPECT_NEAR(glm::distance(moved.normal, glm::dvec3(depth, y, 0) / 0.5), 0, 1e-5);
                const LeafHit<double> stays = strand.nearest(":segments=2,width=projected,roll=fixed", ray);
                EXPECT_NEAR(glm::distance(stays.normal, moved.normal), 0, 1e-6);
                EXPECT_GE(stays.t, moved.t - 1e-6);
            }
        }
}

TEST(Dots, FlatNormalsFaceTheRayFromBothSides) {
    const StraightStrand strand;
    for (const float side : {-1.0f, 1.0f}) {
        const LeafHit<double> hit = strand.nearest(":segments=1,roll=fixed,normals=flat",
                                                   ray_towards({3 * side, 0.2f, 1}, {-side, 0, 0}));
        ASSERT_LT(hit.t, 1e29);
        EXPECT_NEAR(glm::distance(hit.normal, glm::dvec3(side, 0, 0)), 0, 1e-5);
    }
}

TEST(Dots, MovedHitStaysWithinItsPieceAndTheRay) {
    const StraightStrand strand;
    // Nearly along the strand: the round strand's wall lies far up the ray.
    const Ray steep = ray_towards({0.3f, 0.1f, 6}, {0.001f, 0.0005f, -1});
    const LeafHit<double> hit = strand.nearest(":segments=2,roll=fixed,offset=round", steep);
    if (hit.t < 1e29) {
        EXPECT_GE(hit.u, 0);
        EXPECT_LE(hit.u, 1);
    }
    Ray inside = ray_towards({0.3f, 0.1f, 1}, {-1, 0, 0});
    inside.tmin = 0.01f;
    const LeafHit<double> near = strand.nearest(":segments=2,roll=fixed,offset=round", inside);
    ASSERT_LT(near.t, 1e29);
    EXPECT_GE(near.t, inside.tmin);
}

TEST(Dots, DegenerateStrandsGiveFiniteNumbersAndNoHits) {
    Curves curves;
    const glm::vec4 p(1, 2, 3, 0.1f);
    curves.curves = {
        {p, p, p, p},                            // a point
        line({0, 0, 0, 0}, {0, 0, 1, 0}),        // no width
        line({0, 0, 0, 0.1f}, {1, 0, 0, 0.1f}),  // and straight back
        line({1, 0, 0, 0.1f}, {0, 0, 0, 0.1f}),
        {glm::vec4(0, 0, 0, 0.1f), glm::vec4(0, 0, 0, 0.1f), glm::vec4(1, 1, 1, 0.1f), glm::vec4(1, 1, 1, 0)},
        line({1e30f, -1e30f, 0, 1e20f}, {-1e30f, 3e38f, 1, 1e20f}),
        line({0, 0, 0, 1e-30f}, {1e-38f, 0, 0, 1e-30f}),
    };
    curves.strands = {{0, 1}, {1, 1}, {2, 2}, {4, 1}, {5, 1}, {6, 1}};
    for (const std::string options :
         {":segments=1", ":segments=7", ":tolerance=0.1", ":segments=3,offset=round",
          ":segments=3,offset=round,normals=flat,width=projected"}) {
        const Geometry geometry = built_dots(curves, options);
        for (const glm::vec3& vertex : geometry.vertices)
            for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(vertex[k]));
        const size_t skipped = 1;  // seven curves fit into the first record
        for (size_t i = skipped; i < geometry.shading_records.size(); ++i) {
            DotsJointRecord record;
            std::memcpy(&record, geometry.shading_records.bytes.data() + i * sizeof record, sizeof record);
            EXPECT_NEAR(glm::length(glm::dvec4(record.rotation)), 1, 1e-6);
        }
        for (size_t i = 0; i < geometry.leaf_count(); ++i)
            for (uint64_t trial = 0; trial < 50; ++trial) {
                Random random(7, i, trial);
                const glm::uvec3 corners = geometry.triangles[i];
                const Ray ray = ray_at(random, geometry.vertices[corners[random.below(3)]], 1, 0.05);
                LeafHit<float> hit;
                if (!test_leaf(geometry, i, ray, hit)) continue;
                EXPECT_GT(geometry.leaves[i].curve, 1u);  // neither the point nor the line without width
                primitive_named("dots").cpu.finish_single(geometry, i, ray, hit);
                EXPECT_TRUE(std::isfinite(hit.t) && hit.u >= 0 && hit.u <= 1);
                EXPECT_NEAR(glm::length(hit.normal), 1, 1e-4);
            }
    }
    EXPECT_EQ(built_dots(Curves{}).leaf_count(), 0u);
}

TEST(Dots, SurfaceIsTheGeometryThatIsBuilt) {
    const Curves curves = random_curves(8, 9, 3, 0.01);
    const PrimitiveChoice dots = dots_choice(":tolerance=0.3");
    const Geometry geometry = dots.primitive->build(curves, dots.options);
    const Surface surface = dots.primitive->surface(curves, dots.options);
    ASSERT_EQ(surface.triangles.size(), geometry.triangles.size());
    for (size_t i = 0; i < surface.triangles.size(); ++i) {
        const SurfaceTriangle& triangle = surface.triangles[i];
        const Leaf leaf = geometry.leaves[i];
        EXPECT_EQ(triangle.curve, leaf.curve);
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(triangle.vertex[k], geometry.vertices[geometry.triangles[i][k]]);
            EXPECT_TRUE(triangle.u[k] == float(leaf.piece()) / float(leaf.pieces()) ||
                        triangle.u[k] == float(leaf.piece() + 1) / float(leaf.pieces()));
        }
    }
}

TEST(Dots, KernelsFollowTheLeavesWhenTheyAreReordered) {
    const Curves curves = random_curves(9, 6, 2, 0.05);
    Geometry geometry = built_dots(curves, ":segments=2,offset=round");
    const Geometry original = geometry;
    std::vector<uint32_t> order(geometry.leaf_count());
    for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<uint32_t>(order.size() - 1 - i);
    reorder_leaves(geometry, order);
    size_t hits = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        Random random(10, 0, i);
        const glm::uvec3 corners = original.triangles[order[i]];
        const glm::vec3 target =
            (original.vertices[corners.x] + original.vertices[corners.y] + original.vertices[corners.z]) /
            3.0f;
        const Ray ray = ray_at(random, target, 2, 0);
        LeafHit<float> a, b;
        const bool met = test_leaf(geometry, i, ray, a);
        ASSERT_EQ(met, test_leaf(original, order[i], ray, b));
        if (!met) continue;
        ++hits;
        EXPECT_EQ(a.t, b.t);
        EXPECT_EQ(a.u, b.u);
        EXPECT_EQ(a.normal, b.normal);
    }
    EXPECT_GT(hits, order.size() / 2);
}

}  // namespace
}  // namespace strandlab::testing
