// The test that leaves a piece which a ray passes, and the one for gentle crossings, against dense sampling.
#include "base/kernel.h"
#include "base/random.h"

#include <gtest/gtest.h>

#include <vector>

namespace strandlab {
namespace kernels {

template <class real>
struct PieceKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/piece_test.h"
};

}  // namespace kernels

namespace {

using Kernel = kernels::PieceKernel<float>;
using Points = std::array<glm::dvec4, 4>;

glm::dvec4 at(const Points& c, double u) {
    const double v = 1 - u;
    return c[0] * (v * v * v) + c[1] * (3 * v * v * u) + c[2] * (3 * v * u * u) + c[3] * (u * u * u);
}

/// A curve about 1 long that bends by about `bend`; radii near `radius`.
Points random_curve(Random& random, double bend, double radius) {
    Points c;
    for (int i = 0; i < 4; ++i)
        c[i] = {i / 3.0 + bend * random.signed_unit(), bend * random.signed_unit(),
                bend * random.signed_unit(), radius * random.range(0.5, 1.5)};
    return c;
}

struct Case {
    Points curve;
    glm::vec4 rounded[4];
    double a = 0, b = 1;
    glm::vec3 origin, direction;
};

Case random_case(uint64_t index) {
    Random random(91, 0, index);
    Case result;
    const double radius = std::pow(10.0, random.range(-4, -0.5));
    result.curve = random_curve(random, std::pow(10.0, random.range(-3, 0.3)), radius);
    for (int i = 0; i < 4; ++i) {
        result.rounded[i] = glm::vec4(result.curve[i]);
        result.curve[i] = glm::dvec4(result.rounded[i]);
    }
    const int pieces = 1 << int(random.range(0, 4.99)), piece = int(random.range(0, pieces - 1e-9));
    result.a = double(piece) / pieces;
    result.b = double(piece + 1) / pieces;
    const glm::dvec3 direction{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    const glm::dvec4 target = at(result.curve, random.range(result.a, result.b));
    const glm::dvec3 off{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    const glm::dvec3 through = glm::dvec3(target) + off * (2.5 * radius);
    result.direction = glm::vec3(direction * std::pow(10.0, random.range(-1, 1)));
    result.origin = glm::vec3(through - direction * std::pow(10.0, random.range(-1, 2)));
    return result;
}

/// How deep the ray line gets into the balls of the piece, in radii.
struct Depth {
    double deepest = -1e300;
    int runs = 0;  // times that the ray line is inside
};

Depth sampled(const Case& c, int samples) {
    Depth result;
    bool was_inside = false;
    const glm::dvec3 d = glm::normalize(glm::dvec3(c.direction));
    for (int i = 0; i <= samples; ++i) {
        const glm::dvec4 p = at(c.curve, c.a + (c.b - c.a) * i / samples);
        const glm::dvec3 v = glm::dvec3(p) - glm::dvec3(c.origin);
        const double depth = 1 - glm::length(v - d * glm::dot(v, d)) / p.w;
        result.deepest = std::max(result.deepest, depth);
        if (depth > 0 && !was_inside) ++result.runs;
        was_inside = depth > 0;
    }
    return result;
}

bool passes(const Case& c, Kernel::PieceView& view) {
    return Kernel::passes_piece(c.origin, c.direction, c.rounded[0], c.rounded[1], c.rounded[2], c.rounded[3],
                                float(c.a), float(c.b), view);
}

TEST(PiecePassing, NeverLeavesAPieceThatTheRayMeets) {
    int met = 0, passed = 0, beside = 0;
    for (uint64_t i = 0; i < 200000; ++i) {
        const Case c = random_case(i);
        Kernel::PieceView view;
        const bool left = passes(c, view);
        const Depth depth = sampled(c, 16);
        const bool meets = depth.deepest > 0;
        met += meets;
        beside += !meets;
        passed += left;
        ASSERT_FALSE(left && meets) << "case " << i << ", " << depth.deepest << " radii deep";
    }
    EXPECT_GT(met, 20000);
    // Many of the curves bend so much that the plane through ray and chord cuts them.
    EXPECT_GT(passed, beside / 4) << "of " << beside;
}

TEST(PiecePassing, SaysNothingOfDegeneratePieces) {
    Kernel::PieceView view;
    const glm::vec4 point{0, 0, 0, 1e-2f};
    EXPECT_FALSE(Kernel::passes_piece({0, 0, -1}, {0, 0, 1}, point, point, point, point, 0, 1, view));
    EXPECT_FALSE(Kernel::passes_piece({5, 0, -1}, {0, 0, 1}, point, point, point, point, 0, 1, view));
    const glm::vec4 nan{std::nanf(""), 0, 0, 1};
    EXPECT_FALSE(
        Kernel::passes_piece({5, 0, -1}, {0, 0, 1}, point, nan, point, {1, 0, 0, 1e-2f}, 0, 1, view));
    EXPECT_FALSE(
        Kernel::passes_piece({5, 5, -1}, {0, 0, 0}, point, point, point, {1, 0, 0, 1e-2f}, 0, 1, view));
}

TEST(GentleCrossing, MeetsThePieceOnce) {
    int gentle = 0, met = 0;
    for (uint64_t i = 0; i < 200000; ++i) {
        const Case c = random_case(i);
        Kernel::PieceView view;
        passes(c, view);
        float thickest = 0, sagitta_squared = 0;
        if (!Kernel::crosses_gently(c.direction, view,
                                    Kernel::curve_powers(view.edge1, view.edge2, view.edge3), float(c.a),
                                    float(c.b - c.a), c.rounded[0].w, thickest, sagitta_squared))
            continue;
        ++gentle;
        const Depth depth = sampled(c, 200);
        met += depth.runs > 0;
        EXPECT_LE(depth.runs, 1) << "case " << i;
    }
    EXPECT_GT(gentle, 10000);
    EXPECT_GT(met, 3000);
}

}  // namespace
}  // namespace strandlab
