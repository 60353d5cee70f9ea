// Measures of level of detail, on pictures whose differences are known.
#include "measure/lod_sweep.h"

#include "report/lod_chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

/// Hits of rays: a depth each, or a miss where it is 0.
Hits hits_of(const std::vector<float>& depths) {
    Hits hits;
    for (const float t : depths) {
        Hit hit;
        if (t > 0) {
            hit.t = t;
            hit.curve = 0;
        }
        hits.hits.push_back(hit);
    }
    return hits;
}

TEST(LodSweep, ComparesPixelsAndNotRays) {
    // Two samples a pixel; the pictures hit with different rays.
    const Hits full = hits_of({2, 0, 4, 4, 0, 0}), same = hits_of({0, 2, 4, 4, 0, 0});
    const DetailError none = compare_detail(full, same, 2, {}, {});
    EXPECT_EQ(none.coverage, 0.5);
    EXPECT_EQ(none.coverage_bias, 0);
    EXPECT_EQ(none.coverage_rms, 0);
    EXPECT_EQ(none.depth_bias, 0);
    const Hits more = hits_of({3, 3, 5, 5, 0, 0});
    const DetailError error = compare_detail(full, more, 2, hits_of({1, 1, 0, 0}), hits_of({1, 0, 0, 0}));
    EXPECT_NEAR(error.coverage_bias, 1.0 / 3, 1e-12);
    EXPECT_NEAR(error.coverage_rms, std::sqrt(0.25 / 2), 1e-12);
    EXPECT_NEAR(error.depth_bias, 1, 1e-12);
    EXPECT_EQ(error.transmittance, 0.5);
    EXPECT_EQ(error.transmittance_bias, 0.25);
}

TEST(LodSweep, ViewsKeepTheirFraming) {
    Camera camera;
    camera.eye = {0, 0, 2};
    camera.fov = 40;
    const DistantView view = distant_view(camera, 256, 128, 4, 8);
    EXPECT_EQ(view.width, 32u);
    EXPECT_EQ(view.height, 16u);
    EXPECT_EQ(view.samples, 256u);
    EXPECT_NEAR(view.camera.eye.z, 16, 1e-12);
    const auto half = [](const Camera& c) {
        return glm::length(c.eye - c.target) * std::tan(c.fov * 0.008726646259971648);
    };
    EXPECT_NEAR(half(view.camera), half(camera), 1e-12);
}

TEST(LodSweep, ShadowRaysStartBeforeTheHits) {
    Rays primary;
    primary.rays = {{{0, 0, 2}, 0, {0, 0, -2}, 1e30f}, {{1, 0, 2}, 0, {0, 0, -1}, 1e30f}};
    const Rays shadow = detail_shadow_rays(primary, hits_of({0.5f, 0}), {0, 1, 0}, 0.25f);
    ASSERT_EQ(shadow.rays.size(), 1u);
    EXPECT_EQ(shadow.rays[0].origin, glm::vec3(0, 0, 1.25f));
    EXPECT_EQ(shadow.rays[0].direction, glm::vec3(0, 1, 0));
}

TEST(LodSweep, ChartsAreWholeAndEscaped) {
    const std::string chart =
        lod_chart("a <b> & c", {{1, 1, 0, 0, 0, 1, 1, 1}, {2, 0.5, 0.02, 0.1, -0.01, 0.3, 0.4, 0.6}});
    EXPECT_NE(chart.find("a &lt;b&gt; &amp; c"), std::string::npos);
    EXPECT_NE(chart.find("</svg>"), std::string::npos);
    EXPECT_EQ(chart.find("nan"), std::string::npos);
    EXPECT_EQ(lod_chart("nothing", {}), "");
    EXPECT_NE(lod_chart("one", {{1, 1, 0, 0, 0, 1, 1, 1}}).find("1x"), std::string::npos);
}

}  // namespace
}  // namespace strandlab
