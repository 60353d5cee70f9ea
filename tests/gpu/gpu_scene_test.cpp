// Tracing on the device: what comes back for scenes whose hits are known.
#include "trace/gpu_scene.h"

#include "../unit/support/parallel_strands.h"
#include "base/random.h"
#include "gpu_fixture.h"

#include <cmath>

namespace strandlab {
namespace {

Rays rays_down(uint32_t count) {
    Rays rays;
    for (uint32_t i = 0; i < count; ++i)
        rays.rays.push_back({{1.2f, float(i), 5.0f}, 0.0f, {0, 0, -2}, 1e30f});
    return rays;
}

SceneModel model_of(const PrimitiveChoice& choice, const Curves& curves, uint32_t first_curve = 0) {
    return {choice.primitive->build(curves, choice.options), first_curve};
}

class GpuSceneTest : public GpuTest {
  protected:
    static TraceResult trace(const Curves& curves, const Rays& rays, SceneOptions options = {},
                             const TraceOptions& trace_options = {}) {
        const PrimitiveChoice choice = parse_primitive("lss:segments=4");
        options.ray_extent = 10;
        options.normals = true;
        std::vector<SceneModel> models;
        models.push_back(model_of(choice, curves));
        const SceneInstance instance;
        const GpuScene scene(device(), *choice.primitive, std::move(models), {&instance, 1}, options);
        return scene.trace(rays, trace_options);
    }
};

void expect_hits_every_strand(const TraceResult& result, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        const Hit& hit = result.hits.hits[i];
        EXPECT_EQ(hit.curve, i);
        EXPECT_FLOAT_EQ(hit.t, 2.45f);
        EXPECT_NEAR(hit.u, 0.4f, 1e-5f);
        EXPECT_NEAR(result.hits.normals[i].z, 1.0f, 1e-6f);
    }
}

TEST_F(GpuSceneTest, HitsTheStrandBelow) {
    expect_hits_every_strand(trace(parallel_strands(9), rays_down(9)), 9);
}

TEST_F(GpuSceneTest, TheOrderOfLeavesDoesNotMatter) {
    for (const auto order : {SceneOptions::Order::as_built, SceneOptions::Order::median})
        expect_hits_every_strand(trace(parallel_strands(33), rays_down(33), {.order = order}), 33);
}

TEST_F(GpuSceneTest, SeveralStructuresActAsOne) {
    for (const auto order : {SceneOptions::Order::as_built, SceneOptions::Order::median})
        expect_hits_every_strand(
            trace(parallel_strands(33), rays_down(33), {.order = order, .max_leaves = 10}), 33);
}

TEST_F(GpuSceneTest, MissesAreInfinite) {
    Rays rays;
    rays.rays = {{{1.2f, 0.5f, 5.0f}, 0.0f, {0, 0, -2}, 1e30f},   // between two strands
                 {{1.2f, 0.0f, 5.0f}, 0.0f, {0, 0, -2}, 2.0f},    // ends before
                 {{1.2f, 0.0f, 5.0f}, 2.6f, {0, 0, -2}, 1e30f}};  // starts behind the entry
    for (const Hit& hit : trace(parallel_strands(3), rays).hits.hits) {
        EXPECT_FALSE(hit.is_hit());
        EXPECT_TRUE(std::isinf(hit.t));
    }
}

TEST_F(GpuSceneTest, InvalidRaysAreMisses) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    Rays rays;
    rays.rays = {{{nan, 0, 5}, 0, {0, 0, -1}, 1e30f},    {{1.2f, 0, 5}, 0, {0, infinity, -1}, 1e30f},
                 {{1.2f, 0, 5}, 0, {0, 0, 0}, 1e30f},    {{1.2f, 0, 5}, -1, {0, 0, -1}, 1e30f},
                 {{1.2f, 0, 5}, 3, {0, 0, -1}, 2},       {{1.2f, 0, 5}, 0, {0, 0, -1}, nan},
                 {{1.2f, 0, 5}, 0, {0, 0, -1}, infinity}};  // the last one is valid
    const TraceResult result = trace(parallel_strands(1), rays);
    for (size_t i = 0; i + 1 < rays.rays.size(); ++i) EXPECT_FALSE(result.hits.hits[i].is_hit()) << i;
    EXPECT_TRUE(result.hits.hits.back().is_hit());
}

TEST_F(GpuSceneTest, ShadowRaysSayWhetherAnythingIsHit) {
    Rays rays = rays_down(4);
    rays.rays[2].origin.y = 2.5f;
    const TraceResult result = trace(parallel_strands(4), rays, {}, {.shadow = true});
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(result.hits.hits[i].is_hit(), i != 2) << i;
}

TEST_F(GpuSceneTest, InstancesKeepTheirNumbersAndTransforms) {
    const PrimitiveChoice choice = parse_primitive("lss:segments=2");
    std::vector<SceneModel> models;
    models.push_back(model_of(choice, parallel_strands(2), 0));
    models.push_back(model_of(choice, parallel_strands(3), 2));
    // Model 1 twice as large and turned upside down, moved to y = 100; then model 0 moved to y = 200.
    SceneInstance scaled{1, glm::mat4x3(2, 0, 0, 0, -2, 0, 0, 0, -2, 0, 100, 0)};
    SceneInstance moved{0, glm::mat4x3(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 200, 0)};
    const std::vector<SceneInstance> instances = {scaled, moved};
    const GpuScene scene(device(), *choice.primitive, std::move(models), instances,
                         {.ray_extent = 300, .normals = true, .max_leaves = 3});
    Rays rays;
    rays.rays = {{{2.4f, 96, 5}, 0, {0, 0, -1}, 1e30f}, {{1.2f, 201, 5}, 0, {0, 0, -1}, 1e30f}};
    const TraceResult result = scene.trace(rays);
    EXPECT_EQ(result.hits.hits[0].instance, 0u);
    EXPECT_EQ(result.hits.hits[0].curve, 4u);  // third strand of model 1
    EXPECT_FLOAT_EQ(result.hits.hits[0].t, 4.8f);
    EXPECT_NEAR(result.hits.normals[0].z, 1.0f, 1e-6f);
    EXPECT_EQ(result.hits.hits[1].instance, 1u);
    EXPECT_EQ(result.hits.hits[1].curve, 1u);
    EXPECT_FLOAT_EQ(result.hits.hits[1].t, 4.9f);
}

TEST_F(GpuSceneTest, AnEmptySceneIsAllMisses) {
    const TraceResult result = trace(Curves{}, rays_down(2));
    EXPECT_FALSE(result.hits.hits[0].is_hit());
}

TEST_F(GpuSceneTest, NeighbouringPiecesLeaveNoGap) {
    // A bent strand of several pieces, rays through its centre line: every one must hit.
    Curves curves;
    curves.curves.push_back({glm::vec4(0, 0, 0, 0.01f), glm::vec4(1, 0, 0, 0.01f), glm::vec4(1, 1, 0, 0.01f),
                             glm::vec4(2, 1, 0, 0.01f)});
    curves.strands.push_back({0, 1});
    const Geometry geometry = model_of(parse_primitive("lss:segments=4"), curves).geometry;
    const auto* ends = reinterpret_cast<const glm::vec4*>(geometry.leaf_records.bytes.data());
    Rays rays;
    for (uint32_t i = 0; i < 4000; ++i) {
        Random random(1, 0, i);
        const glm::vec4 a = ends[2 * (i % 4)], b = ends[2 * (i % 4) + 1];
        const glm::vec3 target(glm::mix(a, b, float(i / 4) / 999.0f));
        const glm::vec3 direction(random.signed_unit(), random.signed_unit(), random.signed_unit());
        rays.rays.push_back({target - direction * 3.0f, 0.0f, direction, 1e30f});
    }
    const TraceResult result = trace(curves, rays);
    for (size_t i = 0; i < rays.rays.size(); ++i) EXPECT_TRUE(result.hits.hits[i].is_hit()) << i;
}

TEST_F(GpuSceneTest, CurvesOfAStrandShareTheirPoints) {
    // Eight zigzag strands of five curves, rays through every curve.
    Curves curves;
    Rays rays;
    for (uint32_t strand = 0; strand < 8; ++strand) {
        curves.strands.push_back({5 * strand, 5});
        const auto point = [&](uint32_t k) {
            return glm::vec4(float(k), float(4 * strand) + float(k % 2), float(k % 3), 0.05f);
        };
        for (uint32_t k = 0; k < 5; ++k) {
            curves.curves.push_back({point(3 * k), point(3 * k + 1), point(3 * k + 2), point(3 * k + 3)});
            rays.rays.push_back({{3 * float(k) + 1.5f, float(4 * strand) + 0.5f, 9}, 0, {0, 0, -1}, 1e30f});
        }
    }
    for (const char* name : {"prhi", "rocaps"}) {
        const PrimitiveChoice choice = parse_primitive(name);
        const SceneInstance instance;
        const auto scene_with = [&](const SceneOptions& options) {
            std::vector<SceneModel> models;
            models.push_back(model_of(choice, curves));
            return GpuScene(device(), *choice.primitive, std::move(models), {&instance, 1}, options);
        };
        const GpuScene shared = scene_with({.ray_extent = 40});
        const GpuScene separate = scene_with({.ray_extent = 40, .no_skips = {"points"}});
        EXPECT_EQ(shared.cost().record_bytes + (40 - 8) * sizeof(glm::vec4), separate.cost().record_bytes);
        const Hits a = shared.trace(rays).hits, b = separate.trace(rays).hits;
        for (size_t i = 0; i < rays.rays.size(); ++i) {
            EXPECT_EQ(a.hits[i].curve, i) << name;
            EXPECT_EQ(a.hits[i].t, b.hits[i].t) << name << " " << i;
            EXPECT_EQ(b.hits[i].curve, i) << name;
        }
    }
}

}  // namespace
}  // namespace strandlab
