// Caps, starting inside, triangles, invalid input: small surfaces whose hits are known exactly.
#include "base/error.h"
#include "oracle_cases.h"
#include "trace/oracle.h"
#include "trace/reference.h"
#include "trace/scene_oracle.h"

#include <gtest/gtest.h>

#include <limits>

namespace strandlab {
namespace {

using namespace oracle_cases;
using Sweep = Surface::Sweep;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Radius 1 along x from 0 to 4.
Surface cylinder(Sweep sweep, Caps caps, bool straight = false) {
    const Curve c{glm::vec4(0, 0, 0, 1), glm::vec4(4 / 3.0f, 0, 0, 1), glm::vec4(8 / 3.0f, 0, 0, 1),
                  glm::vec4(4, 0, 0, 1)};
    return surface_of(c, sweep, caps, straight);
}

ReferenceHit first(const Surface& surface, const glm::vec3& origin, const glm::vec3& direction,
                   float tmin = 0, float tmax = 1e30f) {
    return Oracle(surface).trace(Ray{origin, tmin, direction, tmax});
}

TEST(OracleCaps, AcrossTheEnds) {
    const double sphere_start = 5 - std::sqrt(0.75);
    for (const Sweep sweep : {Sweep::sphere, Sweep::disc})
        for (const bool straight : {false, true})
            for (const Caps caps : {Caps::round, Caps::open, Caps::flat}) {
                const Surface surface = cylinder(sweep, caps, straight);
                const ReferenceHit start = first(surface, {-5, 0.5f, 0}, {1, 0, 0});
                const ReferenceHit end = first(surface, {9, 0, 0.5f}, {-1, 0, 0});
                const ReferenceHit side = first(surface, {2, 5, 0}, {0, -2, 0});
                EXPECT_NEAR(side.t, 2, 1e-14);
                EXPECT_NEAR(side.u, 0.5, 1e-6);
                EXPECT_NEAR(glm::dot(side.normal, glm::dvec3(0, 1, 0)), 1, 1e-12);
                EXPECT_FALSE(side.on_cap || side.starts_inside);
                EXPECT_EQ(start.is_hit(), caps != Caps::open);
                EXPECT_EQ(end.is_hit(), caps != Caps::open);
                if (caps == Caps::open) continue;
                const double expected = caps == Caps::flat ? 5 : sphere_start;
                for (const ReferenceHit* hit : {&start, &end}) {
                    EXPECT_NEAR(hit->t, expected, 1e-14);
                    EXPECT_TRUE(hit->on_cap);
                    EXPECT_EQ(hit->radius, 1);
                    EXPECT_EQ(hit->u, hit == &start ? 0 : 1);
                    if (caps == Caps::flat) {
                        EXPECT_EQ(hit->normal.x, hit == &start ? -1 : 1);
                    }
                }
            }
}

TEST(OracleCaps, InteriorJointsStayClosedAndAreNoCaps) {
    Surface surface = cylinder(Sweep::sphere, Caps::open);
    surface.pieces[0].ends_strand = false;  // something else is meant to follow
    EXPECT_FALSE(first(surface, {-5, 0.5f, 0}, {1, 0, 0}).is_hit());
    const ReferenceHit joint = first(surface, {9, 0.5f, 0}, {-1, 0, 0});
    ASSERT_TRUE(joint.is_hit());
    EXPECT_FALSE(joint.on_cap);
}

TEST(OracleCaps, HitsOnTheSideOfTheEndDiscMiss) {
    EXPECT_FALSE(first(cylinder(Sweep::disc, Caps::flat), {-5, 1.5f, 0}, {1, 0, 0}).is_hit());
    // Beyond the end plane the swept discs have nothing, the swept balls a round end.
    EXPECT_FALSE(first(cylinder(Sweep::disc, Caps::flat), {-0.5f, 5, 0}, {0, -1, 0}).is_hit());
    EXPECT_NEAR(first(cylinder(Sweep::disc, Caps::round), {-0.5f, 5, 0}, {0, -1, 0}).t, 5 - std::sqrt(0.75),
                1e-14);
    EXPECT_NEAR(first(cylinder(Sweep::sphere, Caps::round), {-0.5f, 5, 0}, {0, -1, 0}).t, 5 - std::sqrt(0.75),
                1e-14);
}

TEST(OracleInside, CurrentPartIsNotSeen) {
    for (const Sweep sweep : {Sweep::sphere, Sweep::disc})
        for (const Caps caps : {Caps::round, Caps::open, Caps::flat}) {
            const Surface surface = cylinder(sweep, caps);
            const ReferenceHit inside = first(surface, {2, 0.25f, 0}, {0, 1, 0.5f});
            EXPECT_TRUE(inside.starts_inside) << name_of(caps);
            EXPECT_FALSE(inside.is_hit());
            // tmin moves the start.
            EXPECT_TRUE(first(surface, {2, 5, 0}, {0, -1, 0}, 4.5f).starts_inside);
            EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -1, 0}, 6.5f).starts_inside);
            EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -1, 0}, 6.5f).is_hit());
            EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -1, 0}, 0, 3.5f).is_hit());
            EXPECT_TRUE(first(surface, {2, 5, 0}, {0, -1, 0}, 0, 4.5f).is_hit());
        }
    EXPECT_TRUE(first(cylinder(Sweep::sphere, Caps::round), {-0.5f, 0, 0}, {0, 1, 0}).starts_inside);
    EXPECT_TRUE(first(cylinder(Sweep::disc, Caps::round), {-0.5f, 0, 0}, {0, 1, 0}).starts_inside);
    EXPECT_FALSE(first(cylinder(Sweep::disc, Caps::flat), {-0.5f, 0, 0}, {0, 1, 0}).starts_inside);
}

TEST(OracleInside, OtherPartsAreSeen) {
    // A horseshoe: from within one leg, the other leg is hit.
    const Curve c{glm::vec4(-2, 0, 0, 0.25f), glm::vec4(-2, 6, 0, 0.25f), glm::vec4(2, 6, 0, 0.25f),
                  glm::vec4(2, 0, 0, 0.25f)};
    for (const Sweep sweep : {Sweep::sphere, Sweep::disc}) {
        const Surface surface = surface_of(c, sweep, Caps::round);
        const ReferenceHit hit = first(surface, {-2, 0.25f, 0}, {1, 0, 0});
        EXPECT_TRUE(hit.starts_inside);
        ASSERT_TRUE(hit.is_hit());
        EXPECT_NEAR(hit.t, 3.75, 0.05);
        EXPECT_GT(hit.u, 0.9);
    }
}

TEST(OracleDegenerate, PointsAndNestedSpheres) {
    Curve point;
    point.fill(glm::vec4(1, 2, 3, 0.5f));
    const ReferenceHit ball = first(surface_of(point, Sweep::sphere, Caps::round), {1, 2, -5}, {0, 0, 1});
    EXPECT_NEAR(ball.t, 7.5, 1e-14);
    EXPECT_FALSE(first(surface_of(point, Sweep::disc, Caps::open), {1, 2, -5}, {0, 0, 1}).is_hit());
    EXPECT_NEAR(first(surface_of(point, Sweep::disc, Caps::round), {1, 2, -5}, {0, 0, 1}).t, 7.5, 1e-14);
    // Radius grows faster than the curve: only the larger end ball is seen.
    const Curve nested{glm::vec4(0, 0, 0, 0.25f), glm::vec4(0.1f, 0, 0, 1), glm::vec4(0.2f, 0, 0, 1.5f),
                       glm::vec4(0.5f, 0, 0, 2)};
    for (const bool straight : {false, true}) {
        const ReferenceHit hit =
            first(surface_of(nested, Sweep::sphere, Caps::round, straight), {-8, 0, 0}, {1, 0, 0});
        EXPECT_NEAR(hit.t, 6.5, 1e-14);
        EXPECT_EQ(hit.u, 1);
        EXPECT_TRUE(hit.on_cap);
    }
    // A tip of radius 0 is no surface.
    const Curve line{glm::vec4(0), glm::vec4(1, 0, 0, 0), glm::vec4(2, 0, 0, 0), glm::vec4(3, 0, 0, 0)};
    EXPECT_FALSE(first(surface_of(line, Sweep::sphere, Caps::round), {1.5f, 0, -5}, {0, 0, 1}).is_hit());
    EXPECT_FALSE(first(surface_of(line, Sweep::disc, Caps::round), {1.5f, 0, -5}, {0, 0, 1}).is_hit());
}

TEST(OracleInput, InvalidRaysAndPiecesMiss) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Surface surface = cylinder(Sweep::sphere, Caps::round);
    EXPECT_FALSE(first(surface, {nan, 5, 0}, {0, -1, 0}).is_hit());
    EXPECT_FALSE(first(surface, {2, 5, 0}, {0, 0, 0}).is_hit());
    EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -infinity, 0}).is_hit());
    EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -1, 0}, 3, 2).is_hit());
    EXPECT_TRUE(first(surface, {2, 5, 0}, {0, -1, 0}, 0, infinity).is_hit());
    surface.pieces[0].control[1].y = nan;
    EXPECT_FALSE(first(surface, {2, 5, 0}, {0, -1, 0}).is_hit());
    EXPECT_FALSE(first(Surface{}, {2, 5, 0}, {0, -1, 0}).is_hit());
}

Surface strip() {
    Surface surface;
    const auto triangle = [&](std::array<glm::vec3, 3> v, std::array<float, 3> u) {
        SurfaceTriangle t{v, v, u, 3};
        for (glm::vec3& c : t.centre) c.y = 0;
        surface.triangles.push_back(t);
    };
    triangle({{{0, -1, 0}, {0, 1, 0}, {4, -1, 0}}}, {0, 0, 1});
    triangle({{{4, 1, 0}, {4, -1, 0}, {0, 1, 0}}}, {1, 1, 0});
    return surface;
}

TEST(OracleTriangles, HitsSharedEdgesAndBothSides) {
    const Surface surface = strip();
    for (const float z : {-3.0f, 3.0f})
        for (const float x : {0.5f, 1.0f, 2.0f, 3.0f, 4.0f}) {  // y = 1 - x / 2 is the diagonal
            for (const float y : {1 - x / 2, 0.25f, -1.0f}) {
                const ReferenceHit hit = first(surface, {x, y, z}, {0, 0, -z});
                ASSERT_TRUE(hit.is_hit()) << x << ' ' << y;
                EXPECT_NEAR(hit.t, 1, 1e-15);
                EXPECT_NEAR(hit.u, x / 4, 1e-15);
                EXPECT_NEAR(hit.radius, 1, 1e-12);
                EXPECT_EQ(hit.curve, 3u);
                EXPECT_EQ(hit.normal.z, z > 0 ? 1 : -1);
            }
            EXPECT_FALSE(first(surface, {x, 1.001f, z}, {0, 0, -z}).is_hit());
            EXPECT_FALSE(first(surface, {x, 0, z}, {1, 0, 0}).is_hit());
        }
    // The strip grows and shrinks about its centre line.
    const Oracle wide(surface, {1.5});
    EXPECT_TRUE(wide.trace(Ray{{2, 1.25f, 3}, 0, {0, 0, -1}, 1e30f}).is_hit());
    EXPECT_FALSE(wide.trace(Ray{{2, 0.75f, 3}, 0, {0, 0, -1}, 1e30f}, OracleOptions{0.5}).is_hit());
}

TEST(OracleReference, DecisiveRays) {
    const Surface surface = cylinder(Sweep::sphere, Caps::open);
    const std::vector<Ray> rays = {
        {{2, 0, 5}, 0, {0, 0, -1}, 1e30f},        // through the middle
        {{2, 0.9995f, 5}, 0, {0, 0, -1}, 1e30f},  // within 1e-3 of the silhouette
        {{2, 1.0005f, 5}, 0, {0, 0, -1}, 1e30f}, {{2, 1.5f, 5}, 0, {0, 0, -1}, 1e30f},  // beside it
        {{0.001f, 0, 5}, 0, {0, 0, -1}, 1e30f},  // within 1e-3 (of the parameter) of the open end
        {{0.02f, 0, 5}, 0, {0, 0, -1}, 1e30f}};
    const Reference reference = make_reference(surface, curves_of(surface.pieces[0].control), rays);
    EXPECT_EQ(reference.decisive, (std::vector<uint8_t>{1, 0, 0, 1, 0, 1}));
    EXPECT_EQ(reference.decisive_place, reference.decisive);
    const std::vector<bool> hits = {true, true, false, false, true, true};
    for (size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(reference.hits[i].is_hit(), hits[i]) << i;
}

TEST(OracleReference, IsWhatThreeTracesSay) {
    // Rays that stay clear of the larger surface are not traced against the others.
    const DecisiveMargin margin;
    const OracleOptions larger{1 + margin.radius, margin.ulps, margin.ends};
    const OracleOptions smaller{1 - margin.radius, margin.ulps, -margin.ends};
    for (const Sweep sweep : {Sweep::sphere, Sweep::disc})
        for (const Caps caps : {Caps::round, Caps::open, Caps::flat}) {
            size_t clear_rays = 0;
            for (size_t i = 0; i < 500; ++i) {
                Random random(61, 0, i);
                const Curve curve = random_curve(static_cast<Family>(i % 7), random);
                const Surface surface = surface_of(curve, sweep, caps);
                const Oracle oracle(surface, larger);
                Ray ray = aimed_ray(curve, random);
                if (i % 3 == 0)  // well beside the curve
                    ray.origin += glm::vec3(across(glm::dvec3(ray.direction), random));
                const Reference reference = make_reference(surface, curves_of(curve), {&ray, 1});
                const ReferenceHit hit = oracle.trace(ray, OracleOptions{});
                const Decided expected = decided(ray, curves_of(curve), hit, oracle.trace(ray, larger),
                                                 oracle.trace(ray, smaller));
                EXPECT_EQ(reference.hits[0].t, hit.t);
                EXPECT_EQ(reference.hits[0].starts_inside, hit.starts_inside);
                EXPECT_EQ(reference.decisive[0] != 0, expected.strand);
                EXPECT_EQ(reference.decisive_place[0] != 0, expected.place);
                bool stays_clear = false;
                oracle.trace(ray, larger, stays_clear);
                clear_rays += stays_clear;
            }
            EXPECT_GT(clear_rays, 50u);
            EXPECT_LT(clear_rays, 300u);
        }
}

TEST(SceneOracle, RefusesWhatItCannotPlace) {
    const Surface surface = strip();
    const SurfaceInstance unknown{1, glm::mat4x3(1.0f), 0}, flat{0, glm::mat4x3(0.0f), 0};
    EXPECT_THROW(SceneOracle({&surface, 1}, {&unknown, 1}), Error);
    EXPECT_THROW(SceneOracle({&surface, 1}, {&flat, 1}), Error);
}

}  // namespace
}  // namespace strandlab
