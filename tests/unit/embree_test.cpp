#include "base/error.h"
#include "base/random.h"
#include "primitives/primitive.h"
#include "trace/embree_reference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

#define REQUIRE_EMBREE() \
    if (!embree_available()) GTEST_SKIP() << "built without Embree"

SurfacePiece straight_piece(const glm::vec4& a, const glm::vec4& b, uint32_t curve, bool begins, bool ends) {
    SurfacePiece piece;
    piece.control = {a, a, b, b};
    piece.curve = curve;
    piece.straight = true;
    piece.begins_strand = begins;
    piece.ends_strand = ends;
    return piece;
}

SurfacePiece cubic_line(const glm::vec4& a, const glm::vec4& b, uint32_t curve) {
    SurfacePiece piece = straight_piece(a, b, curve, true, true);
    piece.control = {a, glm::mix(a, b, 1.0f / 3), glm::mix(a, b, 2.0f / 3), b};
    piece.straight = false;
    return piece;
}

Ray ray_towards(const glm::vec3& origin, const glm::vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

ReferenceHit trace_one(const EmbreeScene& scene, const Ray& ray) {
    ReferenceHit reference;
    Hit hit;
    scene.trace({&ray, 1}, {&reference, 1});
    scene.trace({&ray, 1}, {&hit, 1});
    EXPECT_EQ(hit.curve, reference.curve);
    EXPECT_EQ(double(hit.t), reference.t);
    EXPECT_EQ(double(hit.u), reference.u);
    return reference;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    EXPECT_LE(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Embree, SaysWhetherItIsBuiltIn) {
    EXPECT_EQ(embree_version().empty(), !embree_available());
    if (embree_available()) return;
    try {
        EmbreeScene scene{Surface{}};
        FAIL() << "a scene without Embree";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::usage);
    }
}

/// A cylinder of radius 0.25 along x from 0 to 2: entry points, normals and u are known.
void expect_cylinder(const EmbreeScene& scene, double tolerance) {
    for (const float x : {0.5f, 1.0f, 1.75f})
        for (const float y : {-0.2f, -0.05f, 0.0f, 0.15f}) {
            const double depth = std::sqrt(0.0625 - double(y) * y);
            const ReferenceHit hit = trace_one(scene, ray_towards({x, y, 3}, {0, 0, -2}));
            ASSERT_TRUE(hit.is_hit()) << x << " " << y;
            EXPECT_EQ(hit.curve, 7u);
            EXPECT_NEAR(hit.t, (3 - depth) / 2, tolerance);
            EXPECT_NEAR(hit.u, x / 2, tolerance);
            EXPECT_NEAR(hit.radius, 0.25, 1e-6);
            EXPECT_FALSE(hit.on_cap);
            expect_near(hit.normal, glm::dvec3(0, y, depth) / 0.25, 100 * tolerance);
        }
    EXPECT_FALSE(trace_one(scene, ray_towards({1, 0.26f, 3}, {0, 0, -2})).is_hit());
    EXPECT_FALSE(trace_one(scene, ray_towards({2.3f, 0, 3}, {0, 0, -2})).is_hit());
}

TEST(Embree, CubicCylinderIsExactAndOpen) {
    REQUIRE_EMBREE();
    Surface surface;
    surface.caps = Caps::open;
    surface.sweep = Surface::Sweep::disc;
    surface.pieces = {cubic_line({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 7)};
    const EmbreeScene scene(surface);
    expect_cylinder(scene, 2e-5);
    EXPECT_FALSE(trace_one(scene, ray_towards({-1, 0.1f, 0}, {1, 0, 0})).is_hit()) << "through the open tube";
    // A straight piece of a disc sweep is the same tube.
    surface.pieces = {straight_piece({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 7, true, true)};
    expect_cylinder(EmbreeScene(surface), 2e-5);
}

TEST(Embree, RaysFromInsideDoNotMeetInnerWalls) {
    REQUIRE_EMBREE();
    Surface surface;
    surface.caps = Caps::open;
    surface.sweep = Surface::Sweep::disc;
    surface.pieces = {cubic_line({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 0)};
    EXPECT_FALSE(trace_one(EmbreeScene(surface), ray_towards({1, 0, 0}, {0, 0, 1})).is_hit());
    // The strand behind is seen through the wall from inside.
    surface.pieces.push_back(cubic_line({0, 0, 1, 0.25f}, {2, 0, 1, 0.25f}, 1));
    const ReferenceHit behind = trace_one(EmbreeScene(surface), ray_towards({1, 0, 0}, {0, 0, 1}));
    EXPECT_EQ(behind.curve, 1u);
    EXPECT_NEAR(behind.t, 0.75, 1e-5);
    surface.sweep = Surface::Sweep::sphere;
    surface.pieces = {straight_piece({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 0, true, true)};
    EXPECT_FALSE(trace_one(EmbreeScene(surface), ray_towards({1, 0, 0}, {0, 0, 1})).is_hit());
}

TEST(Embree, SweptSphereLineHasRoundEnds) {
    REQUIRE_EMBREE();
    Surface surface;
    surface.pieces = {straight_piece({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 7, true, true)};
    const EmbreeScene scene(surface);
    expect_cylinder(scene, 2e-5);
    // Not exactly along the axis: such rays Embree 3.13 lets through.
    const ReferenceHit tip = trace_one(scene, ray_towards({-3, 0, 0}, {1, 0.05f, 0}));
    ASSERT_TRUE(tip.is_hit());
    EXPECT_TRUE(tip.on_cap);
    EXPECT_EQ(tip.u, 0);
    // |(-3 + t, 0.05 t)| = 0.25
    const double speed = 1 + 0.0025;
    EXPECT_NEAR(tip.t, (3 - std::sqrt(9 - speed * (9 - 0.0625))) / speed, 1e-5);
    const ReferenceHit beyond = trace_one(scene, ray_towards({2.1f, 0, 3}, {0, 0, -1}));
    ASSERT_TRUE(beyond.is_hit());
    EXPECT_TRUE(beyond.on_cap);
    EXPECT_EQ(beyond.u, 1);
    EXPECT_NEAR(beyond.t, 3 - std::sqrt(0.0625 - 0.01), 1e-5);
}

TEST(Embree, JoinedPiecesHaveNoWallInBetween) {
    REQUIRE_EMBREE();
    Surface surface;
    const glm::vec4 a(0, 0, 0, 0.25f), b(1, 0, 0, 0.25f), c(2, 0, 0, 0.25f);
    surface.pieces = {straight_piece(a, b, 3, true, false), straight_piece(b, c, 3, false, true)};
    surface.pieces[0].u1 = surface.pieces[1].u0 = 0.5f;
    const ReferenceHit joint = trace_one(EmbreeScene(surface), ray_towards({1.0001f, 0.1f, 3}, {0, 0, -1}));
    ASSERT_TRUE(joint.is_hit());
    EXPECT_NEAR(joint.u, 0.5, 1e-3);
    EXPECT_FALSE(joint.on_cap);
    const ReferenceHit second = trace_one(EmbreeScene(surface), ray_towards({1.5f, 0.1f, 3}, {0, 0, -1}));
    EXPECT_NEAR(second.u, 0.75, 1e-5);
}

TEST(Embree, TrianglesAreTwoSidedWithTheirOwnParameter) {
    REQUIRE_EMBREE();
    Surface surface;
    SurfaceTriangle triangle;
    triangle.vertex = {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};
    triangle.centre = {glm::vec3(0, 0.5f, 0), glm::vec3(1, 0.5f, 0), glm::vec3(0, 0.5f, 0)};
    triangle.u = {0.25f, 0.5f, 0.25f};
    triangle.curve = 4;
    surface.triangles = {triangle};
    const EmbreeScene scene(surface);
    for (const float side : {-1.0f, 1.0f}) {
        const ReferenceHit hit = trace_one(scene, ray_towards({0.25f, 0.25f, 2 * side}, {0, 0, -side}));
        ASSERT_TRUE(hit.is_hit());
        EXPECT_EQ(hit.curve, 4u);
        EXPECT_NEAR(hit.t, 2, 1e-6);
        EXPECT_NEAR(hit.u, 0.3125, 1e-6);
        EXPECT_NEAR(hit.radius, 0.25, 1e-6);
        expect_near(hit.normal, {0, 0, side}, 1e-6);
    }
    EXPECT_FALSE(trace_one(scene, ray_towards({0.6f, 0.6f, 2}, {0, 0, -1})).is_hit());
}

TEST(Embree, InvalidRaysAndRangesMiss) {
    REQUIRE_EMBREE();
    Surface surface;
    surface.pieces = {straight_piece({0, 0, 0, 0.25f}, {2, 0, 0, 0.25f}, 7, true, true)};
    const EmbreeScene scene(surface);
    Ray ray = ray_towards({1, 0, 3}, {0, 0, -1});
    ray.tmax = 2.7f;
    EXPECT_FALSE(trace_one(scene, ray).is_hit());
    ray.tmax = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(trace_one(scene, ray).is_hit());
    ray.tmin = 3;
    EXPECT_FALSE(trace_one(scene, ray).is_hit());
    ray.tmin = 0;
    ray.origin.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(trace_one(scene, ray).is_hit());
    EXPECT_FALSE(trace_one(EmbreeScene(Surface{}), ray_towards({1, 0, 3}, {0, 0, -1})).is_hit());
    EXPECT_GT(scene.bytes(), 0u);
}

TEST(Embree, DefinitionNamesWhatItCannotJudge) {
    Surface surface;
    surface.triangles.resize(1);
    EXPECT_TRUE(embree_definition(surface).same_sweep && embree_definition(surface).same_ends);
    surface = {};
    surface.pieces = {cubic_line({0, 0, 0, 1}, {1, 0, 0, 1}, 0)};
    EXPECT_FALSE(embree_definition(surface).same_sweep);
    EXPECT_FALSE(embree_definition(surface).same_ends);
    surface.sweep = Surface::Sweep::disc;
    surface.caps = Caps::open;
    EXPECT_TRUE(embree_definition(surface).same_sweep && embree_definition(surface).same_ends);
    surface.sweep = Surface::Sweep::sphere;
    surface.pieces[0].straight = true;
    EXPECT_TRUE(embree_definition(surface).same_sweep);
    EXPECT_FALSE(embree_definition(surface).same_ends);
}

/// Strands of two curves in a box, through every leaf of a primitive on the CPU.
struct AgreementCount {
    size_t hits = 0, misses = 0, different = 0;
    double worst_t = 0;
};

AgreementCount compare_with_leaves(const std::string& text) {
    Curves curves;
    for (uint32_t s = 0; s < 40; ++s) {
        Random random(21, 0, s);
        curves.strands.push_back({2 * s, 2});
        glm::vec4 last(random.signed_unit(), random.signed_unit(), random.signed_unit(), 0.03f);
        for (int c = 0; c < 2; ++c) {
            Curve curve{last};
            for (int k = 1; k < 4; ++k)
                curve[k] =
                    curve[k - 1] + glm::vec4(0.2 * random.signed_unit(), 0.2 * random.signed_unit(), 0.1, 0);
            last = curve[3];
            curves.curves.push_back(curve);
        }
    }
    const PrimitiveChoice choice = parse_primitive(text);
    const Geometry geometry = choice.primitive->build(curves, choice.options);
    const EmbreeScene scene(choice.primitive->surface(curves, choice.options));
    AgreementCount count;
    for (uint64_t trial = 0; trial < 3000; ++trial) {
        Random random(22, 0, trial);
        const auto point = [&] {
            return glm::vec3(random.signed_unit(), random.signed_unit(), random.signed_unit());
        };
        const glm::vec3 origin = glm::normalize(point()) * 4.0f;
        const Ray ray = ray_towards(origin, point() - origin);
        LeafHit<double> best;
        best.t = 1e30;
        uint32_t curve = no_curve;
        for (size_t i = 0; i < geometry.leaf_count(); ++i) {
            LeafHit<double> hit;
            if (choice.primitive->cpu.precise(geometry, i, ray, best.t, hit))
                best = hit, curve = geometry.leaves[i].curve;
        }
        const ReferenceHit hit = trace_one(scene, ray);
        if (hit.curve != curve) {
            ++count.different;
        } else if (hit.is_hit()) {
            ++count.hits;
            count.worst_t = std::max(count.worst_t, std::abs(hit.t - best.t) * glm::length(ray.direction));
        } else {
            ++count.misses;
        }
    }
    return count;
}

TEST(Embree, AgreesWithTheTriangleStrips) {
    REQUIRE_EMBREE();
    const AgreementCount count = compare_with_leaves("dots:segments=3");
    EXPECT_LE(count.different, 3u);
    EXPECT_GT(count.hits, 300u);
    EXPECT_GT(count.misses, 300u);
    EXPECT_LT(count.worst_t, 1e-4);
}

TEST(Embree, AgreesWithRoundCones) {
    REQUIRE_EMBREE();
    const AgreementCount count = compare_with_leaves("lss:segments=3");
    EXPECT_LE(count.different, 6u);
    EXPECT_GT(count.hits, 300u);
    EXPECT_GT(count.misses, 300u);
    EXPECT_LT(count.worst_t, 0.03);  // one radius: no gross disagreement
}

}  // namespace
}  // namespace strandlab
