// Level of detail: counts, prefixes, thickness, morphing.
#include "strands/hair_mesh/curve_writer.h"
#include "unit/hair_mesh_models.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

using testing_tools::bundled_mesh;
using testing_tools::hair_radius;
using testing_tools::style_with;

uint64_t total(const std::vector<BundleCount>& counts) {
    uint64_t sum = 0;
    for (const BundleCount& count : counts) sum += count.kept;
    return sum;
}

TEST(HairMeshDetail, CountsAreExactAndChangeInFewFacesAtATime) {
    const HairMesh mesh = bundled_mesh("bob");
    for (const uint64_t strands : {1, 143, 144, 1000, 100000, 1234567})
        EXPECT_EQ(total(bundle_counts(mesh, strands, 1, 1)), strands);
    constexpr uint64_t strands = 100000;
    const double smallest_bundle = [&] {
        uint32_t least = ~0u;
        for (const BundleCount& count : bundle_counts(mesh, strands, 1, 1))
            least = std::min(least, count.full);
        return double(least);
    }();
    double ratio_sum = 0;
    int64_t largest_step = 0;
    constexpr int steps = 40000;
    const double from = 1.01 / smallest_bundle;
    auto before = bundle_counts(mesh, strands, 1, from);
    for (int i = 1; i <= steps; ++i) {
        const double lod = from + (0.2 - from) * i / steps;
        auto now = bundle_counts(mesh, strands, 1, lod);
        int64_t changed = 0;
        for (size_t f = 0; f < now.size(); ++f) changed += now[f].kept != before[f].kept;
        largest_step = std::max(largest_step, changed);
        ratio_sum += double(total(now)) / (lod * double(strands));
        before = std::move(now);
    }
    fmt::print("mean count {:.5f} of L N F; at most {} of {} bundles change at once\n", ratio_sum / steps,
               largest_step, mesh.faces.size());
    EXPECT_NEAR(ratio_sum / steps, 1, 1e-3);
    // Three of 64 bundles, one more for every 48 of them.
    EXPECT_LE(largest_step, 6);
}

TEST(HairMeshDetail, KeptStrandsAreAPrefixWithTheSamePoints) {
    const HairMesh mesh = bundled_mesh("wavy");
    const Curves full = grow_hair_mesh(mesh, style_with(mesh, "strands=3000,points=33"));
    const Curves some = grow_hair_mesh(mesh, style_with(mesh, "strands=3000,points=33,lod=0.3,lod_points=1"));
    const auto counts = bundle_counts(mesh, 3000, 1, 0.3);
    size_t first = 0, at = 0;
    for (const BundleCount& count : counts) {
        for (uint32_t i = 0; i < count.kept; ++i, ++at)
            for (uint32_t c = 0; c < 32; ++c)
                for (int k = 0; k < 4; ++k) {
                    const glm::vec4 &a = full.curves[(first + i) * 32 + c][k],
                                    &b = some.curves[at * 32 + c][k];
                    ASSERT_EQ(glm::vec3(a), glm::vec3(b));
                    ASSERT_NEAR(b.w / a.w, 1 / 0.3, 1e-4);
                }
        first += count.full;
    }
    EXPECT_EQ(at, some.strands.size());
    // Fewer points are some of the many: the layer's own curve changes, its points do not.
    const Curves coarse = grow_hair_mesh(mesh, style_with(mesh, "strands=300,points=17"));
    const Curves fine = grow_hair_mesh(mesh, style_with(mesh, "strands=300,points=33"));
    for (size_t c = 0; c < coarse.curves.size(); ++c) ASSERT_EQ(coarse.curves[c][0], fine.curves[2 * c][0]);
}

TEST(HairMeshDetail, LevelsOfPointsAreContinuous) {
    const LevelOfDetail quarter{1, 0.25, 0.5};
    EXPECT_EQ(point_level(64, quarter).pieces, 16u);
    EXPECT_EQ(point_level(64, quarter).morph, 0);
    EXPECT_EQ(point_level(60, {1, 1, 0.5}).pieces, 60u);
    EXPECT_EQ(point_level(64, {1, 1e-6, 0.5}).pieces, 1u);
    double before = 6, largest = 0;
    for (const double window : {0.1, 0.5, 1.0})
        for (double lod = 0.9999; lod > 0.02; lod *= 0.9995) {
            const PointLevel level = point_level(64, {1, lod, window});
            const double effective = std::log2(level.pieces) - level.morph;
            ASSERT_TRUE(level.morph >= 0 && level.morph <= 1);
            if (lod < 0.9995) largest = std::max(largest, std::abs(effective - before));
            before = effective;
        }
    fmt::print("level minus morph changes by {:.4f} at most in steps of 0.05 % of L\n", largest);
    EXPECT_LE(largest, 0.01);
}

TEST(HairMeshDetail, MorphsFromFineToCoarseWithoutAJump) {
    for (const char* name : {"bob", "ringlets"}) {
        const HairMesh mesh = bundled_mesh(name);
        // Just above and just below the change from 64 to 32 pieces, and where morphing begins.
        const auto at = [&](double lod) {
            return grow_hair_mesh<double>(
                mesh, style_with(mesh, fmt::format("strands=300,points=129,lod_points={:.12f}", lod)));
        };
        const auto fine = at(0.25 + 1e-9), coarse = at(0.25), start = at(0.25 * std::sqrt(2.0) - 1e-9),
                   full = at(0.25 * std::sqrt(2.0) + 1e-9);
        ASSERT_EQ(fine.curves.size(), 2 * coarse.curves.size());
        ASSERT_EQ(start.curves.size(), full.curves.size());
        double jump = 0, begin = 0;
        for (size_t c = 0; c < fine.curves.size(); ++c)
            for (const double u : {0.0, 0.3, 0.7, 1.0}) {
                const glm::dvec4 a = point_at(fine.curves[c], u),
                                 b = point_at(coarse.curves[c / 2], (double(c % 2) + u) / 2);
                jump = std::max(jump, glm::length(glm::dvec3(a - b)));
                begin = std::max(begin, glm::length(glm::dvec3(point_at(start.curves[c], u) -
                                                               point_at(full.curves[c], u))));
            }
        fmt::print("{}: jump at the change of level {:.2g} radii, where morphing begins {:.2g}\n", name,
                   jump / hair_radius, begin / hair_radius);
        EXPECT_LE(jump / hair_radius, 1e-5);
        EXPECT_LE(begin / hair_radius, 1e-5);
    }
    // Exactly at both ends.
    std::vector<glm::dvec4> points;
    for (int i = 0; i <= 8; ++i) points.emplace_back(i, std::sin(1.3 * i), std::cos(2.1 * i), 0.1);
    const std::vector<glm::dvec4> every_other{points[0], points[2], points[4], points[6], points[8]};
    std::vector<CurveD> plain(8), morphed(8), coarse(4);
    for (size_t c = 0; c < 8; ++c) {
        const auto record = catmull_rom_curve<double>(points, 1, c);
        plain[c] = {record.b0, record.b1, record.b2, record.b3};
    }
    write_points(every_other, 0.0, coarse.data());
    write_points(points, 0.0, morphed.data());
    EXPECT_EQ(plain, morphed);
    write_points(points, 1.0, morphed.data());
    for (int c = 0; c < 8; ++c)
        for (const double u : {0.0, 0.5, 1.0})
            EXPECT_LT(glm::length(point_at(morphed[c], u) - point_at(coarse[c / 2], (c % 2 + u) / 2)), 1e-14);
}

/// Length times diameter of all strands: what a ray through the hair meets on average.
double projected_area(const Curves& curves) {
    double area = 0;
    for (const Curve& c : curves.curves)
        area += glm::length(glm::dvec3(c[3] - c[0])) * double(c[0].w + c[3].w);
    return area;
}

TEST(HairMeshDetail, OpticalDepthStays) {
    for (const char* name : {"bob", "ringlets", "fur"}) {
        const HairMesh mesh = bundled_mesh(name);
        const double full = projected_area(grow_hair_mesh(mesh, style_with(mesh, "strands=20000,points=33")));
        for (const double lod : {0.5, 0.25, 0.125, 0.0625}) {
            const std::string spec = fmt::format("strands=20000,points=33,lod_points=1,lod={}", lod);
            const double ratio = projected_area(grow_hair_mesh(mesh, style_with(mesh, spec))) / full;
            fmt::print("{} at L = {}: optical depth {:.3f} of the full one\n", name, lod, ratio);
            EXPECT_NEAR(ratio, 1, 0.1) << name << " " << lod;
        }
    }
}

TEST(HairMeshDetail, FollowsTheCamera) {
    EXPECT_EQ(detail_at(1, 0.001, 45, 1080, 1), 1);
    const double detail = detail_at(0.02, 10, 90, 1000, 0.1);  // 2 d tan 45 degrees = 20 m for 1000 pixels
    EXPECT_NEAR(detail, 0.1, 1e-12);
    EXPECT_NEAR(detail_at(0.02, 20, 90, 1000, 0.1), detail / 2, 1e-12);
    EXPECT_GT(bundle_size(bundled_mesh("bob")), 0.005);
    EXPECT_LT(bundle_size(bundled_mesh("bob")), 0.03);
}

}  // namespace
}  // namespace strandlab
