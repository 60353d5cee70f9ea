// Styled strands: what stays, what moves, and how well their curves follow.
#include "base/parallel.h"
#include "scene/bounds.h"
#include "strands/bezier.h"
#include "strands/hair_mesh/curve_writer.h"
#include "strands/hair_mesh/strand_kernel.h"
#include "unit/hair_mesh_models.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

using testing_tools::bundled_mesh;
using testing_tools::hair_mesh_names;
using testing_tools::hair_radius;
using testing_tools::plain_style;
using testing_tools::style_with;

TEST(HairMeshStrands, WithoutAmplitudesAreTheUnstyledOnes) {
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const Curves plain = grow_hair_mesh(mesh, plain_style("points=0,strands=300"));
        // Four pieces a layer: every fourth point is a layer's, the others lie on the cubics.
        const std::string points = std::to_string(4 * mesh.layer_count + 1);
        const Curves sampled = grow_hair_mesh(mesh, plain_style("strands=300,points=" + points));
        double worst = 0;
        for (size_t c = 0; c < sampled.curves.size(); ++c) {
            const CurveD cubic = to_double(plain.curves[c / 4]);
            const glm::dvec3 p(point_at(cubic, double(c % 4) / 4));
            worst = std::max(worst, glm::length(p - glm::dvec3(sampled.curves[c][0])));
        }
        EXPECT_LE(worst, 2e-7) << name;  // float: an ulp at 0.4 m is 3e-8
    }
}

TEST(HairMeshStrands, RootsNeverMove) {
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const Curves plain = grow_hair_mesh(mesh, plain_style("points=0,strands=500"));
        const Curves styled = grow_hair_mesh(
            mesh,
            style_with(
                mesh,
                "strands=500,points=9,clump=1,clump_start=-0.9,curl=0.01,wave=0.01,kink=0.01,noise=0.01,"
                "frizz=0.01,fuzz=0.1,fuzz_share=1,curl_ramp=0,ramp=0,cut=0.5"));
        ASSERT_EQ(plain.strands.size(), styled.strands.size());
        for (size_t s = 0; s < plain.strands.size(); ++s)
            EXPECT_EQ(glm::vec3(plain.curves[plain.strands[s].first][0]),
                      glm::vec3(styled.curves[styled.strands[s].first][0]));
    }
}

/// The strands of each face by their root's bits.
std::vector<Curve> strand_of(const Curves& curves, size_t strand) {
    const auto first = curves.curves.begin() + curves.strands[strand].first;
    return {first, first + curves.strands[strand].count};
}

TEST(HairMeshStrands, DependOnFaceAndIndexAlone) {
    for (const char* name : {"ringlets", "fur"}) {
        const HairMesh mesh = bundled_mesh(name);
        const Curves few = grow_hair_mesh(mesh, style_with(mesh, "strands=700,points=17"));
        const Curves many = grow_hair_mesh(mesh, style_with(mesh, "strands=3000,points=17"));
        const auto few_counts = bundle_counts(mesh, 700, 1, 1), many_counts = bundle_counts(mesh, 3000, 1, 1);
        size_t few_first = 0, many_first = 0;
        for (size_t f = 0; f < few_counts.size(); ++f) {
            for (uint32_t i = 0; i < few_counts[f].kept; ++i)
                ASSERT_EQ(strand_of(few, few_first + i), strand_of(many, many_first + i)) << "face " << f;
            few_first += few_counts[f].kept;
            many_first += many_counts[f].kept;
        }
        const uint64_t all_threads = hash(many);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(hash(grow_hair_mesh(mesh, style_with(mesh, "strands=3000,points=17"))), all_threads);
        EXPECT_NE(hash(grow_hair_mesh(mesh, style_with(mesh, "strands=3000,points=17,seed=2"))), all_threads);
    }
}

TEST(HairMeshStrands, GiveTheBitsOfEveryOtherMachine) {
    const std::pair<const char*, uint64_t> golden[] = {
        {"bob", 0x8bce55bc4007d5b3u},  {"wavy", 0x4a2305482a7bf6f6u},     {"ringlets", 0xd9f8128fd530a83u},
        {"afro", 0x80a435e7ad5076c6u}, {"ponytail", 0x915d85d971f047d8u}, {"braid", 0x904d4f0691a5c90eu},
        {"fur", 0x2ba0468679910a6du},
    };
    for (const auto& [name, expected] : golden) {
        const HairMesh mesh = bundled_mesh(name);
        const uint64_t sum = hash(grow_hair_mesh(mesh, style_with(mesh, "strands=300,points=33")));
        EXPECT_EQ(sum, expected) << name << std::hex << " " << sum;
    }
}

TEST(HairMeshStrands, FloatIsNearDouble) {
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const Parameters style = style_with(mesh, "strands=500");
        const auto exact = grow_hair_mesh<double>(mesh, style);
        const Curves curves = grow_hair_mesh(mesh, style);
        double worst = 0;
        for (size_t c = 0; c < curves.curves.size(); ++c)
            for (int i = 0; i < 4; ++i)
                worst = std::max(
                    worst, glm::length(glm::dvec3(curves.curves[c][i]) - glm::dvec3(exact.curves[c][i])));
        fmt::print("{}: float differs from double by {:.2g} radii at most\n", name, worst / hair_radius);
        EXPECT_LE(worst / hair_radius, 0.05) << name;
    }
}

/// Distance of the curves from the ideal strand, sampled eight times as densely.
TEST(HairMeshStrands, CurvesFollowTheIdealStrand) {
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const uint32_t pieces = mesh.style.integer("points") - 1;
        const auto coarse = grow_hair_mesh<double>(mesh, style_with(mesh, "strands=200"));
        const auto fine = grow_hair_mesh<double>(
            mesh, style_with(mesh, fmt::format("strands=200,points={}", 8 * pieces + 1)));
        std::vector<double> errors;
        double bound_ratio = 0;
        for (size_t s = 0; s < coarse.strands.size(); ++s) {
            double worst = 0, third = 0;
            const size_t first = coarse.strands[s].first, fine_first = fine.strands[s].first;
            for (uint32_t k = 0; k < 8 * pieces; ++k) {
                const glm::dvec3 p(point_at(coarse.curves[first + k / 8], double(k % 8) / 8));
                worst = std::max(worst, glm::length(p - glm::dvec3(fine.curves[fine_first + k][0])));
                if (k + 3 > 8 * pieces - 1) continue;
                const auto at = [&](uint32_t i) { return glm::dvec3(fine.curves[fine_first + k + i][0]); };
                third = std::max(third,
                                 glm::length(at(3) - 3.0 * at(2) + 3.0 * at(1) - at(0)) * 512);  // h^3 |f'''|
            }
            errors.push_back(worst / hair_radius);
            bound_ratio = std::max(bound_ratio, worst / third);
        }
        std::sort(errors.begin(), errors.end());
        fmt::print(
            "{}: {} points, off the ideal strand by {:.2g} radii (median), {:.2g} (p99); {:.3f} h^3 |f'''| "
            "at most\n",
            name, pieces + 1, errors[errors.size() / 2], errors[errors.size() * 99 / 100], bound_ratio);
        EXPECT_LE(errors[errors.size() * 99 / 100], 20) << name;
    }
}

TEST(HairMeshStrands, PiecesTurnLessThanARightAngleAndFillTheirBoxes) {
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const Curves curves = grow_hair_mesh(mesh, style_with(mesh, "strands=1500"));
        double most = 0;
        size_t outside = 0;
        for (size_t c = 0; c < curves.curves.size(); ++c) {
            const CurveD exact = to_double(curves.curves[c]);
            most = std::max(most, turning_bound(exact));
            if (c % 7 != 0) continue;
            const Box box = padded(bounds_of(curves.curves[c]), 1.0f);
            for (int i = 0; i <= 64; ++i) {
                const glm::dvec4 p = point_at(exact, i / 64.0);
                for (int axis = 0; axis < 3; ++axis)
                    outside += !(p[axis] - p.w >= box.low[axis] && p[axis] + p.w <= box.high[axis]);
            }
        }
        fmt::print("{}: a piece turns by {:.0f} degrees at most\n", name, most * 57.2957795);
        EXPECT_LT(most * 57.2957795, 90) << name;
        EXPECT_EQ(outside, 0u) << name;
    }
}

/// No point deeper than 3 % under the ellipsoid that the columns grow from (tools/make_hair_meshes).
TEST(HairMeshStrands, StayOutOfTheHead) {
    const glm::dvec3 axes(0.076, 0.115, 0.097);
    const double c = std::cos(0.15), s = std::sin(0.15);
    for (const char* name : hair_mesh_names) {
        if (std::string(name) == "braid") continue;  // hangs alone
        const HairMesh mesh = bundled_mesh(name);
        const Curves curves = grow_hair_mesh(mesh, style_with(mesh, "strands=6000"));
        double deepest = 1;
        for (const Curve& curve : curves.curves)
            for (const int i : {0, 3}) {
                const glm::dvec3 p(curve[i]), own(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
                deepest = std::min(deepest, glm::length(own / axes));
            }
        fmt::print("{}: {:.1f} % under the head at most\n", name, 100 * (1 - deepest));
        EXPECT_GE(deepest, 0.97) << name;
    }
}

TEST(HairMeshKernel, SineAndNoiseAreWhatTheyShouldBe) {
    using Double = kernels::HairStrandKernel<double>;
    double worst = 0, largest = 0, sum = 0, square = 0, jump = 0;
    for (int i = -20000; i <= 20000; ++i) {
        const double x = i * 0.00037;
        worst =
            std::max(worst, std::abs(Double::sine_of_turns(x) - std::sin(2 * 3.14159265358979323846 * x)));
    }
    constexpr int count = 200000;
    glm::dvec2 before(0);
    for (int i = 0; i < count; ++i) {
        const double w = i * 1e-3;
        const int k = Double::floor_of(w);
        const auto below = Double::noise_plane(5, 0.3 + 1e-4 * i, -7.7, k),
                   above = Double::noise_plane(5, 0.3 + 1e-4 * i, -7.7, k + 1);
        const glm::dvec2 n = Double::noise_between(below, above, w - k);
        largest = std::max(largest, std::abs(n.x));
        sum += n.x;
        square += n.x * n.x;
        if (i > 0) jump = std::max(jump, glm::length(n - before));
        before = n;
    }
    fmt::print("sine off by {:.2g}; noise: mean {:.3f}, deviation {:.2f}, largest {:.2f}, step {:.3f}\n",
               worst, sum / count, std::sqrt(square / count), largest, jump);
    EXPECT_LE(worst, 1e-8);
    EXPECT_NEAR(sum / count, 0, 0.05);
    EXPECT_NEAR(std::sqrt(square / count), 0.35, 0.15);
    EXPECT_LE(jump, 0.02);  // continuous across the planes
    size_t below_half = 0;
    for (uint32_t i = 0; i < 100000; ++i)
        below_half += HairStrandKernel::random_of(HairStrandKernel::combine(1, i), 4) < 0.5f;
    EXPECT_NEAR(double(below_half), 50000, 800);
}

}  // namespace
}  // namespace strandlab
