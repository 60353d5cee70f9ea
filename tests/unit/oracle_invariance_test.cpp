// Moving, scaling, reversing and splitting a curve must change nothing. All coordinates are multiples of
// 2^-12, so that each of these is exact in float.
#include "base/parallel.h"
#include "oracle_cases.h"
#include "trace/oracle.h"
#include "trace/reference.h"
#include "trace/scene_oracle.h"

#include <gtest/gtest.h>

#include <atomic>

namespace strandlab {
namespace {

using namespace oracle_cases;

constexpr float grid = 1.0f / 4096;

float snapped(float x) { return std::round(x / grid) * grid; }
glm::vec3 snapped(const glm::vec3& v) { return {snapped(v.x), snapped(v.y), snapped(v.z)}; }

Curve snapped(Curve c) {
    for (glm::vec4& p : c) p = glm::vec4(snapped(glm::vec3(p)), std::max(snapped(p.w), 2 * grid));
    return c;
}

struct Case {
    Curve curve;
    Ray ray;
};

Case make_case(size_t i) {
    Random random(21, 0, i);
    const auto family = static_cast<Family>(random.below(4));
    Case c{snapped(random_curve(family == Family::thin ? Family::degenerate : family, random)), {}};
    c.ray = aimed_ray(c.curve, random);
    c.ray.origin = snapped(c.ray.origin);
    c.ray.direction = snapped(c.ray.direction);
    return c;
}

/// Compares the hit of a changed case with the original one: t, and u through `u_of`.
template <class Change, class ParameterOf>
void expect_unchanged(Change change, ParameterOf u_of, double scale = 1, bool same_side_caps = true) {
    for (const Surface::Sweep sweep : {Surface::Sweep::sphere, Surface::Sweep::disc})
        for (const Caps caps : {Caps::round, Caps::open, Caps::flat}) {
            if (!same_side_caps && sweep == Surface::Sweep::sphere && caps != Caps::round) continue;
            std::atomic<size_t> undecided{0};
            parallel_for(count(1500), [&](size_t i) {
                const Case before = make_case(i);
                const Surface surface = surface_of(before.curve, sweep, caps);
                Surface changed = surface;
                Ray ray = before.ray;
                change(changed, ray);
                const Reference reference =
                    make_reference(surface, curves_of(before.curve), {&before.ray, 1});
                if (!reference.decisive[0] || !reference.decisive_place[0]) {
                    ++undecided;
                    return;
                }
                const ReferenceHit a = reference.hits[0], b = Oracle(changed).trace(ray);
                ASSERT_EQ(a.is_hit(), b.is_hit())
                    << "case " << i << " caps " << name_of(caps) << " t " << a.t << ' ' << b.t;
                EXPECT_EQ(a.starts_inside, b.starts_inside) << "case " << i;
                if (!a.is_hit()) return;
                const double length = double(glm::length(before.ray.direction));
                EXPECT_LT(std::abs(a.t - b.t) * length / a.radius, 1e-9)
                    << "case " << i << " caps " << name_of(caps);
                // A curve that folds back on itself passes the same place at two parameters.
                const bool same_point =
                    glm::length(point_at(to_double(before.curve), a.u) -
                                point_at(to_double(before.curve), u_of(b.u))) < 1e-4 * a.radius;
                EXPECT_TRUE(same_point || std::abs(a.u - u_of(b.u)) < 1e-4)
                    << "case " << i << ' ' << a.u << ' ' << b.u;
                EXPECT_NEAR(b.radius / a.radius, scale, 1e-3 * scale) << "case " << i;
                EXPECT_NEAR(glm::length(b.normal), 1, 1e-12);
            });
            EXPECT_LT(undecided.load(), count(1500) / 20);
        }
}

double same(double u) { return u; }

template <class Point>
void move_points(Surface& surface, Ray& ray, const Point& point, float radius_scale = 1) {
    for (SurfacePiece& piece : surface.pieces)
        for (glm::vec4& p : piece.control) p = glm::vec4(point(glm::vec3(p), 1.0f), p.w * radius_scale);
    ray.origin = point(ray.origin, 1.0f);
    ray.direction = point(ray.direction, 0.0f);
}

TEST(OracleInvariance, Rotation) {
    expect_unchanged(
        [](Surface& s, Ray& r) {
            move_points(s, r, [](const glm::vec3& p, float) { return glm::vec3(-p.z, p.x, -p.y); });
        },
        same);
}

TEST(OracleInvariance, Translation) {
    expect_unchanged(
        [](Surface& s, Ray& r) {
            move_points(s, r, [](const glm::vec3& p, float w) { return p + w * glm::vec3(512, -1024, 256); });
        },
        same);
}

TEST(OracleInvariance, Scale) {
    for (const float scale : {1.0f / 1048576, 1048576.0f, 3.0f}) {
        expect_unchanged(
            [scale](Surface& s, Ray& r) {
                move_points(
                    s, r, [scale](const glm::vec3& p, float) { return scale * p; }, scale);
            },
            same, double(scale));
    }
}

TEST(OracleInvariance, Reversal) {
    expect_unchanged(
        [](Surface& s, Ray&) {
            std::swap(s.pieces[0].control[0], s.pieces[0].control[3]);
            std::swap(s.pieces[0].control[1], s.pieces[0].control[2]);
        },
        [](double u) { return 1 - u; });
}

TEST(OracleInvariance, Split) {
    // Open and flat ends of swept spheres are left out: through an open end a ray sees the closed joint.
    expect_unchanged(
        [](Surface& s, Ray&) {
            const SurfacePiece whole = s.pieces[0];
            const auto part = [&](double a, double b) {
                SurfacePiece piece = whole;
                piece.control = to_float(restricted(to_double(whole.control), a, b));
                piece.u0 = float(a);
                piece.u1 = float(b);
                piece.begins_strand = a == 0;
                piece.ends_strand = b == 1;
                return piece;
            };
            s.pieces = {part(0, 0.5), part(0.5, 1)};
        },
        same, 1, false);
}

TEST(OracleInvariance, Instance) {
    // The scene with a placed surface against the surface moved by hand: signed axes, scale 2, translation.
    const glm::mat4x3 transform(glm::vec3(0, 2, 0), glm::vec3(0, 0, -2), glm::vec3(-2, 0, 0),
                                glm::vec3(8, -4, 2));
    parallel_for(count(500), [&](size_t i) {
        const Case c = make_case(i);
        const Surface surface = surface_of(c.curve, Surface::Sweep::sphere, Caps::round);
        Surface moved = surface;
        Ray ray = c.ray;
        move_points(
            moved, ray, [&](const glm::vec3& p, float w) { return transform * glm::vec4(p, w); }, 2);
        const std::vector<SurfaceInstance> instances = {{0, glm::mat4x3(1.0f), 5}, {0, transform, 7}};
        SurfaceInstance only = instances[1];
        const SceneOracle scene({&surface, 1}, {&only, 1});
        const ReferenceHit a = Oracle(moved).trace(ray), b = scene.trace(ray);
        ASSERT_EQ(a.is_hit(), b.is_hit());
        if (!a.is_hit()) return;
        EXPECT_NEAR(a.t, b.t, 1e-12 * a.t);
        EXPECT_NEAR(a.radius, b.radius, 1e-12 * a.radius);
        EXPECT_LT(glm::length(a.normal - b.normal), 1e-6);
        EXPECT_EQ(b.curve, 7u);
        const SceneOracle both({&surface, 1}, instances);
        const ReferenceHit first = Oracle(surface).trace(ray), nearest = both.trace(ray);
        EXPECT_EQ(nearest.instance, first.t < a.t ? 0u : 1u);
        EXPECT_EQ(nearest.curve, first.t < a.t ? 5u : 7u);
    });
}

}  // namespace
}  // namespace strandlab
