#include "primitives/dots.h"

#include "base/random.h"
#include "primitives/strand_frames.h"
#include "strands/bezier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace strandlab {
namespace {

constexpr double pi = 3.14159265358979323846;

PrimitiveChoice choice(const std::string& options) { return parse_primitive("dots" + options); }

Geometry built(const Curves& curves, const std::string& options = "") {
    const PrimitiveChoice dots = choice(options);
    return dots.primitive->build(curves, dots.options);
}

Curve line(const glm::vec4& a, const glm::vec4& b) {
    return {a, glm::mix(a, b, 1.0f / 3), glm::mix(a, b, 2.0f / 3), b};
}

/// Strands of a few joined curves each, with changing radii.
Curves random_curves(uint64_t seed, uint32_t strands, uint32_t per_strand, double radius) {
    Curves curves;
    for (uint32_t s = 0; s < strands; ++s) {
        Random random(seed, 0, s);
        curves.strands.push_back({static_cast<uint32_t>(curves.curves.size()), per_strand});
        glm::vec4 last(random.signed_unit(), random.signed_unit(), random.signed_unit(), radius);
        for (uint32_t c = 0; c < per_strand; ++c) {
            Curve curve;
            curve[0] = last;
            for (int k = 1; k < 4; ++k)
                curve[k] = curve[k - 1] + glm::vec4(0.3 * random.signed_unit(), 0.3 * random.signed_unit(),
                                                    0.3, -radius * 0.2 / per_strand);
            last = curve[3];
            curves.curves.push_back(curve);
        }
    }
    return curves;
}

std::vector<StrandFrame> frames_along(const std::vector<glm::vec4>& points, double roll = 0) {
    std::vector<StrandFrame> frames;
    FrameCarrier carrier(points, roll);
    for (size_t i = 0; i < points.size(); ++i) frames.push_back(carrier.advance());
    return frames;
}

void expect_orthonormal(const StrandFrame& frame) {
    EXPECT_NEAR(glm::length(frame.axis_0), 1, 1e-12);
    EXPECT_NEAR(glm::length(frame.axis_1), 1, 1e-12);
    EXPECT_NEAR(glm::dot(frame.axis_0, frame.axis_1), 0, 1e-12);
}

/// Length and direction of what is left of both end axes across the chord between them.
void expect_untwisted(const glm::vec4& a, const glm::vec4& b, const StrandFrame& start,
                      const StrandFrame& end) {
    const glm::dvec3 chord = glm::normalize(glm::dvec3(b) - glm::dvec3(a));
    const auto across = [&](const glm::dvec3& v) { return v - chord * glm::dot(chord, v); };
    for (const auto& [from, to] :
         {std::pair(start.axis_0, end.axis_0), std::pair(start.axis_1, end.axis_1)}) {
        EXPECT_GE(glm::length(across(from)), 0.5 - 1e-6);
        EXPECT_GE(glm::length(across(to)), 0.5 - 1e-6);
        EXPECT_GT(glm::dot(across(from), across(to)), 0);
    }
}

TEST(StrandFrames, PlaneCurveKeepsItsNormalAxis) {
    std::vector<glm::vec4> points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(std::cos(0.15 * i), std::sin(0.15 * i), 0, 0.01);
    // The frame whose second axis is the plane's normal keeps it; so does every other by its angle to it.
    const std::vector<StrandFrame> frames = frames_along(points, 0.3);
    for (const StrandFrame& frame : frames) {
        expect_orthonormal(frame);
        EXPECT_NEAR(frame.axis_0.z, frames[0].axis_0.z, 1e-12);
        EXPECT_NEAR(frame.axis_1.z, frames[0].axis_1.z, 1e-12);
    }
}

TEST(StrandFrames, HelixTurnsByItsTorsionAgainstTheNormal) {
    // A rotation-minimising frame turns against the Frenet normal by the integral of the torsion.
    const double radius = 1, rise = 0.5, length_per_angle = std::hypot(radius, rise);
    const double torsion = rise / (radius * radius + rise * rise);
    std::vector<glm::vec4> points;
    const int n = 2000;
    const double end = 3 * pi;
    for (int i = 0; i <= n; ++i) {
        const double a = end * i / n;
        points.emplace_back(radius * std::cos(a), radius * std::sin(a), rise * a, 0.01);
    }
    const std::vector<StrandFrame> frames = frames_along(points);
    const auto angle_at = [&](int i) {  // of axis 0 from the normal towards the binormal
        const double a = end * i / n;
        const glm::dvec3 normal(-std::cos(a), -std::sin(a), 0);
        const glm::dvec3 tangent =
            glm::dvec3(-radius * std::sin(a), radius * std::cos(a), rise) / length_per_angle;
        return std::atan2(glm::dot(frames[i].axis_0, glm::cross(tangent, normal)),
                          glm::dot(frames[i].axis_0, normal));
    };
    double turned = angle_at(n - 1) - angle_at(1);
    const double expected = -torsion * length_per_angle * end * (n - 2) / n;
    EXPECT_NEAR(std::remainder(turned - expected, 2 * pi), 0, 1e-4);
}

TEST(StrandFrames, SharpTurnsAndReversalsNeitherTwistNorVanish) {
    for (uint64_t trial = 0; trial < 2000; ++trial) {
        Random random(11, 0, trial);
        std::vector<glm::vec4> points{glm::vec4(0, 0, 0, 1)};
        for (int i = 0; i < 12; ++i) {
            glm::vec4 step(random.signed_unit(), random.signed_unit(), random.signed_unit(), 0);
            // Exact reversals, right angles and zigzags among random turns.
            if (i > 1 && random.below(4) == 0) step = points[points.size() - 2] - points.back();
            if (random.below(4) == 0) step = glm::vec4(i % 2 ? 1 : 0, i % 2 ? 0 : 1, 0, 0);
            points.push_back(points.back() + step);
        }
        const std::vector<StrandFrame> frames = frames_along(points, random.range(0, pi));
        for (size_t i = 0; i < points.size(); ++i) {
            expect_orthonormal(frames[i]);
            if (i > 0) expect_untwisted(points[i - 1], points[i], frames[i - 1], frames[i]);
        }
    }
}

TEST(StrandFrames, RepeatedPointsShareAFrame) {
    const std::vector<glm::vec4> points{{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 2},
                                        {1, 0, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1}};
    const std::vector<StrandFrame> frames = frames_along(points);
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(2, 3), std::pair(3, 4), std::pair(5, 6)}) {
        EXPECT_EQ(frames[a].axis_0, frames[b].axis_0);
        EXPECT_EQ(frames[a].axis_1, frames[b].axis_1);
    }
    expect_untwisted(points[1], points[2], frames[1], frames[2]);
    expect_untwisted(points[4], points[5], frames[4], frames[5]);
    for (const StrandFrame& frame : frames_along({3, glm::vec4(1, 2, 3, 4)})) expect_orthonormal(frame);
}

TEST(Dots, FourTrianglesAPieceAndFourVerticesAJoint) {
    const Curves curves = random_curves(1, 7, 3, 0.01);
    const Geometry geometry = built(curves, ":segments=5");
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
    const Geometry geometry = built(curves, ":segments=2");
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
        const Surface surface =
            parse_primitive(std::string("dots") + option).primitive->surface(curves, choice(option).options);
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
        const double angle = 2 * pi * (i + 0.5) / n;
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
        const Geometry geometry = built(curves, options);
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

template <class Real>
bool test_leaf(const Geometry& geometry, size_t i, const Ray& ray, LeafHit<Real>& hit) {
    const CpuIntersectors& cpu = primitive_named("dots").cpu;
    if constexpr (std::is_same_v<Real, float>)
        return cpu.single(geometry, i, ray, ray.tmax, hit);
    else
        return cpu.precise(geometry, i, ray, double(ray.tmax), hit);
}

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

Ray ray_at(Random& random, const glm::vec3& target, double distance, double scatter) {
    const glm::dvec3 from(random.signed_unit(), random.signed_unit(), random.signed_unit());
    Ray ray;
    ray.origin = glm::vec3(glm::dvec3(target) + glm::normalize(from) * distance);
    const glm::dvec3 aim =
        glm::dvec3(target) +
        scatter * glm::dvec3(random.signed_unit(), random.signed_unit(), random.signed_unit());
    ray.direction = glm::vec3((aim - glm::dvec3(ray.origin)) * random.range(0.3, 3) / distance);
    ray.tmax = 1e30f;
    return ray;
}

template <class Real>
void expect_agreement(double distance, Real tolerance, Real t_tolerance) {
    const Curves curves = random_curves(3, 20, 2, 0.02);
    const PrimitiveChoice dots = choice(":segments=2,width=projected");
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
    const Geometry geometry = built(curves, ":segments=1");
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

/// A straight strand along z with radius 0.5 and fixed strips; rays from +x.
struct StraightStrand {
    Curves curves;
    StraightStrand() {
        curves.curves = {line({0, 0, 0, 0.5f}, {0, 0, 4, 0.5f})};
        curves.strands = {{0, 1}};
    }
    /// The nearest hit among all leaves.
    LeafHit<double> nearest(const std::string& options, const Ray& ray) const {
        const Geometry geometry = built(curves, options);
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
        const Geometry geometry = built(curves, options);
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
    EXPECT_EQ(built(Curves{}).leaf_count(), 0u);
}

TEST(Dots, SurfaceIsTheGeometryThatIsBuilt) {
    const Curves curves = random_curves(8, 9, 3, 0.01);
    const PrimitiveChoice dots = choice(":tolerance=0.3");
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
    Geometry geometry = built(curves, ":segments=2,offset=round");
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
}  // namespace strandlab
