// Rays that random ones never are: exactly parallel, perpendicular, through the axis, through the plane of
// symmetry, tangent. Coordinates are small binary fractions, so nothing is rounded away.
#include "base/parallel.h"
#include "oracle_brute_force.h"
#include "oracle_cases.h"
#include "trace/oracle.h"
#include "trace/reference.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace strandlab {
namespace {

using namespace oracle_cases;

Curve curve_of(std::array<glm::vec3, 4> p, float r0, float r1) {
    Curve c;
    for (int i = 0; i < 4; ++i) c[i] = glm::vec4(p[i], r0 + (r1 - r0) * float(i) / 3.0f);
    return c;
}

/// Straight, symmetric, S-shaped, folded, with zero end tangents.
std::vector<Curve> structured_curves() {
    const std::vector<std::array<glm::vec3, 4>> shapes = {
        {{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}},      // straight, uniform
        {{{-1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {1, 0, 0}}},                  // straight, both end tangents zero
        {{{-1, 0, 0}, {-0.5f, 1, 0}, {0.5f, 1, 0}, {1, 0, 0}}},            // arc, symmetric in x
        {{{-1, -0.5f, 0}, {-0.25f, 1, 0}, {0.25f, -1, 0}, {1, 0.5f, 0}}},  // S
        {{{-1, 0, 0}, {1.5f, 1, 0}, {-1.5f, 1, 0}, {1, 0, 0}}},            // loop
        {{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}}},                    // one zero end tangent
        {{{-1, 0, 0}, {2, 0, 0}, {-2, 0, 0}, {1, 0, 0}}},                  // folds back on itself
    };
    std::vector<Curve> curves;
    for (const auto& shape : shapes)
        for (const auto& [r0, r1] :
             {std::pair{0.125f, 0.125f}, {0.25f, 0.0625f}, {0.0f, 0.25f}, {1 / 1024.0f, 1 / 1024.0f}})
            curves.push_back(curve_of(shape, r0, r1));
    return curves;
}

std::vector<Ray> structured_rays(float radius) {
    std::vector<Ray> rays;
    const std::vector<glm::vec3> directions = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1},
                                               {0, 0, -1}, {1, 1, 0},  {1, 0, 1}, {0, 1, 1},  {1, 1, 1}};
    std::vector<glm::vec3> targets;
    for (const float x : {-1.5f, -1.0f, -0.5f, 0.0f, 0.5f, 1.0f})
        for (const float y : {-0.5f, 0.0f, 0.25f, 0.75f}) targets.emplace_back(x, y, 0);
    const std::vector<glm::vec3> shifts = {
        {0, 0, 0}, {0, radius / 2, 0}, {0, 0, radius / 2}, {radius / 2, 0, 0}, {0, radius, 0}};
    for (const glm::vec3& d : directions)
        for (const glm::vec3& p : targets)
            for (const glm::vec3& s : shifts) {
                // Along a straight side exactly: neither margin of the radius hits an open tube, and both
                // answers are right (TangentRaysEnd).
                if (s.y == radius && d.y == 0 && d.z == 0) continue;
                rays.push_back({p + s - 8.0f * d, 0, d, 1e30f});
            }
    return rays;
}

struct Tally {
    std::atomic<size_t> rays{0}, decisive{0}, hits{0}, wrong{0}, long_double_wrong{0};
};

void check(Surface::Sweep sweep, Caps caps) {
    Tally tally;
    const std::vector<Curve> curves = structured_curves();
    parallel_for(curves.size(), [&](size_t c) {
        const Curve& curve = curves[c];
        const Surface surface = surface_of(curve, sweep, caps);
        const std::vector<Ray> all = structured_rays(curve[3].w);
        std::vector<Ray> rays;
        const size_t step = count(1) > 1 ? 1 : 10;
        for (size_t i = c % step; i < all.size(); i += step) rays.push_back(all[i]);
        const Reference reference = make_reference(surface, curves_of(curve), rays);
        const Oracle oracle(surface);
        for (size_t i = 0; i < rays.size(); ++i) {
            ++tally.rays;
            const ReferenceHit& hit = reference.hits[i];
            const ReferenceHit extended = oracle.trace(rays[i], OracleOptions{.extended = true});
            if (!reference.decisive_place[i]) continue;
            // A ray that lies in the plane of an open end is not told apart by any margin of the radius.
            if (sweep == Surface::Sweep::disc && hit.is_hit() && (hit.u == 0 || hit.u == 1)) continue;
            ++tally.decisive;
            tally.hits += hit.is_hit();
            const brute_force::Search search(curve, rays[i]);
            const brute_force::Result expected =
                sweep == Surface::Sweep::disc ? search.discs() : search.spheres(caps);
            const auto differs = [&](bool other, long double t) {
                if (other != hit.is_hit()) return true;
                return hit.is_hit() && std::abs(double(t) - hit.t) > 1e-6 * hit.radius;
            };
            const bool wrong = differs(expected.hit, expected.t);
            if (wrong && ++tally.wrong < 5)
                ADD_FAILURE() << fmt::format(
                    "curve {} ray o {} {} {} d {} {} {}: t {} u {} radius {}, dense search t {} u {}", c,
                    rays[i].origin.x, rays[i].origin.y, rays[i].origin.z, rays[i].direction.x,
                    rays[i].direction.y, rays[i].direction.z, hit.t, hit.u, hit.radius, double(expected.t),
                    double(expected.u));
            if (differs(extended.is_hit(), extended.t) && ++tally.long_double_wrong < 5)
                ADD_FAILURE() << fmt::format("curve {} ray {}: t {} u {}, long double t {} u {}", c, i, hit.t,
                                             hit.u, extended.t, extended.u);
        }
    });
    fmt::print(
        "structured: {} rays, {} decisive, {} hits, {} differ from dense search, {} from long double\n",
        tally.rays.load(), tally.decisive.load(), tally.hits.load(), tally.wrong.load(),
        tally.long_double_wrong.load());
    EXPECT_EQ(tally.wrong.load(), 0u);
    EXPECT_EQ(tally.long_double_wrong.load(), 0u);
    EXPECT_GT(tally.hits.load(), tally.rays.load() / 20);
}

TEST(OracleStructured, SpheresRound) { check(Surface::Sweep::sphere, Caps::round); }
TEST(OracleStructured, SpheresOpen) { check(Surface::Sweep::sphere, Caps::open); }
TEST(OracleStructured, Discs) { check(Surface::Sweep::disc, Caps::open); }

TEST(OracleStructured, TangentRaysEnd) {
    // Grazing a cylinder exactly along a line of its side, and across it: either answer is right.
    const Curve cylinder =
        curve_of({{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}}, 0.25f, 0.25f);
    for (const Surface::Sweep sweep : {Surface::Sweep::sphere, Surface::Sweep::disc}) {
        const Surface surface = surface_of(cylinder, sweep, Caps::round);
        const Oracle oracle(surface);
        for (const Ray& ray :
             {Ray{{-4, 0.25f, 0}, 0, {1, 0, 0}, 1e30f}, Ray{{0, 0.25f, -4}, 0, {0, 0, 1}, 1e30f}}) {
            const ReferenceHit hit = oracle.trace(ray);
            if (hit.is_hit()) {
                EXPECT_GT(hit.t, 2);
                EXPECT_LT(hit.t, 7);
            }
        }
    }
}

TEST(OracleStructured, RayThroughATipOfRadiusZero) {
    // The solid is entered at the tip, which has no surface: never a point inside the cone instead.
    const Curve tip = curve_of({{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}}, 0, 0.25f);
    for (const bool straight : {false, true})
        for (const Caps caps : {Caps::round, Caps::open}) {
            const Surface surface = surface_of(tip, Surface::Sweep::sphere, caps, straight);
            const Ray along{{-9.5f, 0, 0}, 0, {1, 0, 0}, 1e30f};
            EXPECT_FALSE(Oracle(surface).trace(along).is_hit()) << straight << name_of(caps);
            if (caps == Caps::round) {
                EXPECT_EQ(make_reference(surface, curves_of(tip), {&along, 1}).decisive[0], 0);
            }
        }
}

TEST(OracleStructured, RaysAlongATaperingTubeOfDiscs) {
    // The side is the cone |(y, z)| = r(x), met in one point; exactly parallel, H vanishes nowhere else.
    const Curve cone = curve_of({{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}}, 0.375f, 0);
    const auto radius = [](double x) { return 0.1875 - 0.125 * x; };
    for (const bool reversed : {false, true}) {
        Curve curve = cone;
        if (reversed) std::reverse(curve.begin(), curve.end());
        const Surface surface = surface_of(curve, Surface::Sweep::disc, Caps::open);
        for (const bool extended : {false, true})
            for (const float y : {1 / 64.0f, 0.1f, 0.1875f, 0.2f, 1 / 3.0f, 0.36f})
                for (const float tilt : {0.0f, 1e-12f, 1e-9f, -1e-9f, 1e-8f, -1e-8f, 3e-8f, 1e-7f, -1e-7f,
                                         1e-6f, -1e-6f, 1e-5f, -1e-4f, 1e-3f}) {
                    const Oracle oracle(surface, OracleOptions{.extended = extended});
                    const Ray from_tip{{4, y, 0}, 0, {-1, tilt, 0}, 1e30f};
                    // y + tilt t = 0.1875 - 0.125 (4 - t)
                    const double t = (double(y) + 0.3125) / (0.125 - double(tilt));
                    ASSERT_GT(radius(4 - t), 0);
                    const ReferenceHit hit = oracle.trace(from_tip);
                    ASSERT_TRUE(hit.is_hit()) << reversed << extended << ' ' << y << ' ' << tilt;
                    EXPECT_NEAR(hit.t, t, 1e-12) << reversed << extended << ' ' << y << ' ' << tilt;
                    EXPECT_NEAR(hit.normal.x, 1 / std::sqrt(65.0), 1e-6);
                    // From the open end the wall is met from behind.
                    const Ray from_base{{-4, y, 0}, 0, {1, tilt, 0}, 1e30f};
                    EXPECT_FALSE(oracle.trace(from_base).is_hit()) << y << ' ' << tilt;
                }
    }
}

TEST(OracleStructured, ZeroEndTangentsGiveNoPoints) {
    // H vanishes with C' at u = 0 for any ray; seen from the other end, rounding must not make that a hit.
    const float r = 1 / 4096.0f;
    Curve curve{glm::vec4(263, 114, -1725, 110) * r, glm::vec4(263, 114, -1725, 101) * r,
                glm::vec4(-417, -189, 1979, 92) * r, glm::vec4(-417, -189, 1979, 82) * r};
    const Ray ray{glm::vec3(-11804, -1059, -3735) * r, 0, glm::vec3(10649, 1064, 1702) * r, 1e30f};
    for (const bool reversed : {false, true}) {
        if (reversed) std::reverse(curve.begin(), curve.end());
        const Surface surface = surface_of(curve, Surface::Sweep::disc, Caps::open);
        for (const bool extended : {false, true})
            EXPECT_FALSE(Oracle(surface, OracleOptions{.extended = extended}).trace(ray).is_hit())
                << reversed << extended;
    }
}

TEST(OracleStructured, ExitThroughTheRimIsNoEntry) {
    // The end ball is entered at its pole, behind the open end, and left exactly at the rim, u = 0.
    const Curve tube = curve_of({{{-1.5f, 0, 0}, {-0.5f, 0, 0}, {0.5f, 0, 0}, {1.5f, 0, 0}}}, 0.125f, 0.125f);
    for (const bool straight : {false, true}) {
        const Surface surface = surface_of(tube, Surface::Sweep::sphere, Caps::open, straight);
        for (const glm::vec3& d : {glm::vec3(1, 1, 0), glm::vec3(1, 0, -1), glm::vec3(1, 1, 1)})
            for (const bool extended : {false, true}) {
                const Ray ray{glm::vec3(-1.625f, 0, 0) - 8.0f * d, 0, d, 1e30f};
                EXPECT_FALSE(Oracle(surface, OracleOptions{.extended = extended}).trace(ray).is_hit());
            }
    }
}

TEST(OracleStructured, RayAlongTheAxis) {
    const Curve cone = curve_of({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}, 0.5f, 0.125f);
    for (const bool straight : {false, true}) {
        const Surface surface = surface_of(cone, Surface::Sweep::sphere, Caps::round, straight);
        const Oracle oracle(surface);
        EXPECT_EQ(oracle.trace(Ray{{-2, 0, 0}, 0, {1, 0, 0}, 1e30f}).t, 1.5);
        EXPECT_EQ(oracle.trace(Ray{{5, 0, 0}, 0, {-1, 0, 0}, 1e30f}).t, 1.875);
    }
}

}  // namespace
}  // namespace strandlab
