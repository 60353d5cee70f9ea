// Columns, their directions, and unstyled strands.
#include "base/random.h"
#include "strands/bezier.h"
#include "strands/generator_parts.h"
#include "strands/hair_mesh/bundle.h"
#include "strands/hair_mesh/columns.h"
#include "strands/hair_mesh/frames.h"
#include "strands/hair_mesh/root_samples.h"
#include "unit/hair_mesh_models.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

using testing_tools::bundled_mesh;
using testing_tools::hair_mesh_names;
using testing_tools::hair_radius;
using testing_tools::plain_style;
using testing_tools::style_with;

constexpr double degrees = 57.29577951308232;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * degrees;
}

TEST(HairMeshColumns, StrandsAreCatmullRomOfTheirOwnPoints) {
    double worst = 0, worst_kink = 0;
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const HairMeshColumns columns = make_columns(mesh);
        const auto grown = grow_hair_mesh<double>(mesh, style_with(mesh, "points=0,strands=400"));
        ASSERT_EQ(grown.curves.size(), 400u * mesh.layer_count);
        for (const StrandRange& strand : grown.strands) {
            std::vector<glm::dvec3> points, expected(3 * mesh.layer_count + 1);
            for (uint32_t c = 0; c < strand.count; ++c)
                points.emplace_back(grown.curves[strand.first + c][0]);
            points.emplace_back(grown.curves[strand.first + strand.count - 1][3]);
            catmull_rom_column(columns.knots, points.data(), expected.data());
            for (uint32_t c = 0; c < strand.count; ++c) {
                const auto& curve = grown.curves[strand.first + c];
                for (uint32_t i = 0; i < 4; ++i)
                    worst = std::max(worst, glm::length(glm::dvec3(curve[i]) - expected[3 * c + i]));
                if (c == 0) continue;
                const auto& before = grown.curves[strand.first + c - 1];
                worst_kink = std::max(worst_kink, angle_between(glm::dvec3(before[3] - before[2]),
                                                                glm::dvec3(curve[1] - curve[0])));
            }
        }
    }
    fmt::print("control points off by {:.2g} m, kink {:.2g} degrees at most\n", worst, worst_kink);
    EXPECT_LE(worst, 1e-12);
    EXPECT_LE(worst_kink, 1e-9);
}

TEST(HairMeshColumns, EndPiecesAreParabolas) {
    const std::vector<double> knots{0.7, 1.1, 0.9};
    const glm::dvec3 points[] = {{0, 0, 0}, {1, 0.5, 0}, {2, 2, 1}, {2, 3, 3}};
    glm::dvec3 b[10];
    catmull_rom_column(knots, points, b);
    for (const int first : {0, 6})
        EXPECT_LT(glm::length(b[first + 3] - 3.0 * b[first + 2] + 3.0 * b[first + 1] - b[first]), 1e-14);
    EXPECT_GT(glm::length(b[6] - 3.0 * b[5] + 3.0 * b[4] - b[3]), 0.01);
    glm::dvec3 line[4];
    catmull_rom_column({2.0}, points, line);
    EXPECT_LT(glm::length(line[1] - (2.0 * points[0] + points[1]) / 3.0), 1e-15);
}

/// Two quadratics in place of a cubic (Truong, Yuksel and Seiler 2020) are off by |D| / 54 at most, D being
/// the third difference: why columns stay cubics here.
TEST(HairMeshColumns, TwoQuadraticsAreOffByAFiftyFourthOfTheThirdDifference) {
    double worst = 0;
    for (uint64_t trial = 0; trial < 200; ++trial) {
        Random random(7, 0, trial);
        glm::dvec3 p[4];
        for (glm::dvec3& x : p) x = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
        const CurveD cubic{glm::dvec4(p[0], 0), glm::dvec4(p[1], 0), glm::dvec4(p[2], 0),
                           glm::dvec4(p[3], 0)};
        const glm::dvec3 q1 = p[0] + 0.75 * (p[1] - p[0]), q3 = p[3] + 0.75 * (p[2] - p[3]),
                         q2 = 0.5 * (q1 + q3);
        double largest = 0;
        for (int i = 0; i <= 600; ++i) {
            const double u = i / 600.0, s = u < 0.5 ? 2 * u : 2 * u - 1, r = 1 - s;
            const glm::dvec3 a = u < 0.5 ? p[0] : q2, b = u < 0.5 ? q1 : q3, c = u < 0.5 ? q2 : p[3];
            const glm::dvec3 quadratic = r * r * a + 2 * r * s * b + s * s * c;
            largest = std::max(largest, glm::length(quadratic - glm::dvec3(point_at(cubic, u))));
        }
        worst = std::max(worst, std::abs(largest - glm::length(p[3] - 3.0 * p[2] + 3.0 * p[1] - p[0]) / 54));
    }
    fmt::print("error of two quadratics differs from |D| / 54 by {:.2g}\n", worst);
    EXPECT_LE(worst, 1e-12);
}

TEST(HairMeshFrames, RecoverAffineMapsAndTurnWithTheMesh) {
    double worst_map = 0, worst_turn = 0;
    for (uint64_t trial = 0; trial < 500; ++trial) {
        Random random(8, 0, trial);
        const auto vector = [&] { return random_direction(random); };
        const glm::dvec3 u = vector(), v = vector(), origin = vector();
        std::array<glm::dvec2, 3> uv;
        for (auto& x : uv) x = {random.signed_unit(), random.signed_unit()};
        const glm::dvec2 e = uv[1] - uv[0], f = uv[2] - uv[0];
        if (std::abs(e.x * f.y - e.y * f.x) < 0.05) continue;
        std::array<glm::dvec3, 3> points, turned;
        const glm::dvec3 axis = vector();
        const double angle = 3 * random.signed_unit();
        const auto turn = [&](const glm::dvec3& p) {  // Rodrigues
            return p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) +
                   axis * glm::dot(axis, p) * (1 - std::cos(angle));
        };
        for (int i = 0; i < 3; ++i) {
            points[i] = origin + uv[i].x * u + uv[i].y * v;
            turned[i] = turn(points[i]);
        }
        const SurfaceDirections a = surface_directions(points, uv), b = surface_directions(turned, uv);
        worst_map = std::max({worst_map, glm::length(a.u - u), glm::length(a.v - v)});
        worst_turn = std::max({worst_turn, glm::length(b.u - turn(a.u)), glm::length(b.v - turn(a.v))});
    }
    fmt::print("affine map off by {:.2g}, rotation by {:.2g}\n", worst_map, worst_turn);
    EXPECT_LE(worst_map, 1e-13);
    EXPECT_LE(worst_turn, 1e-13);
}

/// Column blends at points of a shared edge, seen from both faces.
TEST(HairMeshFrames, BothSidesOfEverySharedEdgeAgree) {
    size_t edges = 0;
    double worst = 0;
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const HairMeshColumns exact = make_columns(mesh);
        const ColumnNumbers<double> columns(mesh, exact);
        // Weights at the fraction t of edge k of a face, counted from its end where `reversed`.
        const auto blended = [&](const HairMeshFace& face, uint32_t k, float t) {
            glm::vec4 weights(0);
            weights[int(k)] = 1 - t;
            weights[int((k + 1) % face.corners)] = t;
            BlendedColumn<double> column;
            column.blend_all_of(columns, face, glm::dvec4(weights));
            return column;
        };
        for (size_t f = 0; f < mesh.faces.size(); ++f)
            for (size_t g = f + 1; g < mesh.faces.size(); ++g)
                for (uint32_t k = 0; k < mesh.faces[f].corners; ++k)
                    for (uint32_t m = 0; m < mesh.faces[g].corners; ++m) {
                        const auto from = [](const HairMeshFace& face, uint32_t i) {
                            return face.vertex[i % face.corners];
                        };
                        if (from(mesh.faces[f], k) != from(mesh.faces[g], m + 1) ||
                            from(mesh.faces[f], k + 1) != from(mesh.faces[g], m))
                            continue;
                        ++edges;
                        const auto a = blended(mesh.faces[f], k, 0.25f), b = blended(mesh.faces[g], m, 0.75f);
                        for (uint32_t l = 0; l <= mesh.layer_count; ++l)
                            worst =
                                std::max({worst, glm::length(a.u[l] - b.u[l]), glm::length(a.v[l] - b.v[l])});
                    }
    }
    fmt::print("{} shared edges, directions differ by {:.2g}\n", edges, worst);
    EXPECT_GT(edges, 1000u);
    EXPECT_LE(worst, 1e-15);
}

TEST(HairMeshFrames, CarriedOnesAreUnitAndAcrossTheColumn) {
    double worst_length = 0, worst_tilt = 0;
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        if (mesh.frames != FrameRule::root) continue;
        const HairMeshColumns columns = make_columns(mesh);
        EXPECT_FALSE(divergence(mesh, columns)) << *divergence(mesh, columns);
        for (uint32_t i = 0; i < columns.vertices; ++i)
            for (uint32_t l = 0; l <= columns.layers; ++l) {
                const glm::dvec3* b = &columns.controls[i * columns.control_count()];
                const glm::dvec3 tangent =
                    glm::normalize(l < columns.layers ? b[3 * l + 1] - b[3 * l] : b[3 * l] - b[3 * l - 1]);
                const size_t at = size_t(i) * (columns.layers + 1) + l;
                for (const glm::dvec3& d : {columns.u[at], columns.v[at]}) {
                    worst_length = std::max(worst_length, std::abs(glm::length(d) - 1));
                    worst_tilt = std::max(worst_tilt, std::abs(glm::dot(d, tangent)));
                }
                EXPECT_NEAR(glm::dot(glm::cross(columns.u[at], columns.v[at]), tangent), 1, 1e-9);
            }
    }
    fmt::print("length off by {:.2g}, along the column by {:.2g}\n", worst_length, worst_tilt);
    EXPECT_LE(worst_length, 1e-12);
    EXPECT_LE(worst_tilt, 1e-6);
}

TEST(HairMeshFrames, StrandsFollowRigidMotion) {
    const glm::dmat3 turn(0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6);
    double worst = 0;
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        HairMesh moved = mesh;
        for (glm::dvec3& p : moved.positions) p = turn * p + glm::dvec3(120, -30, 70);
        const Parameters style = style_with(mesh, "strands=200");
        const auto a = grow_hair_mesh<double>(mesh, style), b = grow_hair_mesh<double>(moved, style);
        for (size_t c = 0; c < a.curves.size(); ++c)
            for (int i = 0; i < 4; ++i) {
                const glm::dvec3 expected = turn * glm::dvec3(a.curves[c][i]) + glm::dvec3(0.12, -0.03, 0.07);
                worst = std::max(worst, glm::length(expected - glm::dvec3(b.curves[c][i])));
            }
    }
    fmt::print("rigid motion moves strands rigidly within {:.2g} radii\n", worst / hair_radius);
    EXPECT_LE(worst, 1e-3 * hair_radius);
}

}  // namespace
}  // namespace strandlab
