#include "report/shading.h"

#include "trace/ray_sets.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <vector>

namespace strandlab {
namespace {

/// Two strands, and a 4 x 2 picture whose hits are set by hand: two samples per pixel.
struct Scene {
    Curves curves;
    Rays rays;
    Hits hits;
    ShadingOptions options;

    Scene() {
        for (const float x : {0.0f, 0.5f})
            for (const float y : {1.0f, 0.0f})
                curves.curves.push_back({glm::vec4(x, y, 0, 0.1f), glm::vec4(x, y - 0.3f, 0, 0.1f),
                                         glm::vec4(x, y - 0.6f, 0, 0.1f), glm::vec4(x, y - 1, 0, 0.1f)});
        curves.strands = {{0, 2}, {2, 2}};
        rays = primary_rays({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30}, {4, 2, 2});
        hits.hits.resize(16);
        hits.normals.resize(16, glm::vec3(0, 0, 1));
        options.width = 4;
        options.height = 2;
        options.samples = 2;
        options.to_light = {0, 0, 1};
    }
    void hit(size_t ray, float t, uint32_t curve, float u = 0.5f) { hits.hits[ray] = {t, u, curve, 0}; }
    Image image(std::span<const float> visible = {}) const {
        return shade(rays, hits, curves, options, visible);
    }
};

glm::vec3 colour_of(const Image& image, size_t pixel) {
    const std::vector<float>& v = image.with_channel("R")->floats();
    return {v[3 * pixel], v[3 * pixel + 1], v[3 * pixel + 2]};
}

TEST(Shading, MissesAreTheBackgroundGradient) {
    const Scene scene;
    const Image image = scene.image();
    EXPECT_EQ(image.width, 4u);
    EXPECT_EQ(image.height, 2u);
    const ShadingOptions& o = scene.options;
    for (size_t p = 0; p < 8; ++p) {
        const glm::vec3 expected = glm::mix(o.background_top, o.background_bottom, p < 4 ? 0.25f : 0.75f);
        EXPECT_LT(glm::length(colour_of(image, p) - expected), 1e-6);
        EXPECT_EQ(image.with_channel("mask")->integers()[p], 0u);
        EXPECT_EQ(image.with_channel("id.strand")->integers()[2 * p + 1], no_curve);
        EXPECT_EQ(image.with_channel("depth.Z")->floats()[p], std::numeric_limits<float>::infinity());
    }
}

TEST(Shading, LayersHoldTheNearestSample) {
    Scene scene;
    scene.hit(4, 5.0f, 1, 0.25f);
    scene.hit(5, 4.0f, 2, 0.75f);
    scene.hits.normals[5] = glm::vec3(0.6f, 0, 0.8f);
    scene.hit(9, 3.0f, 3);
    const Image image = scene.image();
    const auto integers = [&](const char* name) { return image.with_channel(name)->integers(); };
    EXPECT_EQ(integers("mask")[2], 2u);
    EXPECT_EQ(integers("mask")[4], 1u);
    EXPECT_EQ(integers("id.curve")[4], 2u);
    EXPECT_EQ(integers("id.curve")[5], 1u);  // the strand
    EXPECT_EQ(integers("id.curve")[8], 3u);
    EXPECT_EQ(image.with_channel("depth.Z")->floats()[2], 4.0f);
    EXPECT_EQ(image.with_channel("u")->floats()[2], 0.75f);
    EXPECT_EQ(image.with_channel("normal.X")->floats()[6], 0.6f);
}

TEST(Shading, ColourIsTheMeanOfTheSamples) {
    Scene both, first, second;
    both.hit(4, 5.0f, 1);
    both.hit(5, 4.0f, 2);
    first.hit(4, 5.0f, 1);
    second.hit(5, 4.0f, 2);
    const glm::vec3 background = colour_of(Scene().image(), 2);
    const glm::vec3 expected = colour_of(first.image(), 2) + colour_of(second.image(), 2) - background;
    EXPECT_LT(glm::length(colour_of(both.image(), 2) - expected), 1e-6);
}

TEST(Shading, LightThatIsBlockedLeavesAmbientOnly) {
    Scene scene;
    for (size_t i = 0; i < 16; ++i) scene.hit(i, 5.0f, 0);
    const std::vector<float> dark(16, 0.0f), bright(16, 1.0f);
    EXPECT_EQ(colour_of(scene.image(bright), 3), colour_of(scene.image(), 3));
    EXPECT_LT(colour_of(scene.image(dark), 3).g, 0.7f * colour_of(scene.image(), 3).g);
    EXPECT_GT(colour_of(scene.image(dark), 3).g, 0);
    scene.options.ambient = 0;
    EXPECT_EQ(colour_of(scene.image(dark), 3), glm::vec3(0));
}

TEST(Shading, LightAlongAStrandScattersLess) {
    Scene scene;
    for (size_t i = 0; i < 16; ++i) scene.hit(i, 5.0f, 0);
    scene.options.ambient = 0;
    scene.options.to_light = glm::normalize(glm::dvec3(0, 0.2, 1));
    const float across = colour_of(scene.image(), 1).g;
    scene.options.to_light = glm::normalize(glm::dvec3(0, 1, 0.2));
    EXPECT_LT(colour_of(scene.image(), 1).g, across);
}

TEST(Shading, StrandsDifferAndVariationCanBeTurnedOff) {
    Scene one, other;
    for (size_t i = 0; i < 16; ++i) {
        one.hit(i, 5.0f, 0);
        other.hit(i, 5.0f, 2);
    }
    EXPECT_GT(glm::length(colour_of(one.image(), 1) - colour_of(other.image(), 1)), 1e-4);
    one.options.variation = other.options.variation = 0;
    EXPECT_LT(glm::length(colour_of(one.image(), 1) - colour_of(other.image(), 1)), 1e-6);
}

TEST(Shading, HostileHitsGiveFinitePictures) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Scene scene;
    scene.hit(0, nan, 0);
    scene.hit(1, 5.0f, 4);  // no such curve
    scene.hit(2, 5.0f, 0, nan);
    scene.hit(3, 5.0f, 0, 7.0f);
    scene.hit(4, 5.0f, 0);
    scene.hits.normals[4] = glm::vec3(nan);
    scene.hit(6, 5.0f, 0);
    scene.hits.normals[6] = glm::vec3(0);
    for (glm::vec4& point : scene.curves.curves[1]) point = glm::vec4(0, 0, 0, 0.1f);
    scene.hit(8, 5.0f, 1);
    const Image image = scene.image();
    for (const float value : image.with_channel("R")->floats())
        EXPECT_TRUE(std::isfinite(value) && value >= 0);
    EXPECT_EQ(image.with_channel("mask")->integers()[0], 0u);

    scene.hits.normals.clear();
    const Image without_normals = scene.image();
    for (const float value : without_normals.with_channel("R")->floats()) EXPECT_TRUE(std::isfinite(value));
}

TEST(Shading, TheSameForAnyNumberOfThreads) {
    Scene scene;
    for (size_t i = 0; i < 16; i += 3) scene.hit(i, 5.0f, static_cast<uint32_t>(i % 4));
    const Image many = scene.image();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Image one = scene.image();
    for (size_t l = 0; l < many.layers.size(); ++l)
        EXPECT_TRUE(many.layers[l].values == one.layers[l].values);
}

}  // namespace
}  // namespace strandlab
