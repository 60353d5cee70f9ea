// Ray queries give the answers of the ray-tracing pipeline, and instrumented shaders count what happens.
#include "../conformance/conformance_scene.h"
#include "gpu_fixture.h"
#include "trace/cpu_trace.h"
#include "trace/gpu_scene.h"

namespace strandlab {
namespace {

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Primitive& primitive : primitives()) all.push_back(primitive.name);
    return all;
}

struct QueryDevice {
    static DeviceOptions options() { return {.ray_query = true, .pipeline_statistics = true}; }
};

/// Every primitive, on a device with ray queries; skipped where there is none.
class TraversalTest : public DeviceTest<QueryDevice>, public testing::WithParamInterface<std::string> {
  protected:
    GpuScene scene(SceneOptions options, const std::vector<SceneInstance>& instances = {{}}) const {
        std::vector<SceneModel> models;
        models.push_back({choice.primitive->build(curves, choice.options), 0});
        options.ray_extent = 10;
        return GpuScene(device(), *choice.primitive, std::move(models), instances, options);
    }

    const PrimitiveChoice choice = parse_primitive(GetParam());
    const Curves curves = conformance_curves();
    Rays rays{.rays = conformance_rays(curves)};
};

void expect_same(const Hits& a, const Hits& b) {
    ASSERT_EQ(a.hits.size(), b.hits.size());
    for (size_t i = 0; i < a.hits.size(); ++i) {
        EXPECT_EQ(a.hits[i].t, b.hits[i].t) << i;
        EXPECT_EQ(a.hits[i].curve, b.hits[i].curve) << i;
        EXPECT_EQ(a.hits[i].u, b.hits[i].u) << i;
        EXPECT_EQ(a.hits[i].instance, b.hits[i].instance) << i;
    }
    ASSERT_EQ(a.normals.size(), b.normals.size());
    for (size_t i = 0; i < a.normals.size(); ++i)
        EXPECT_LT(glm::length(a.normals[i] - b.normals[i]), 1e-5f) << i;
}

TEST_P(TraversalTest, QueriesGiveTheAnswersOfThePipeline) {
    if (!device().can_query_rays()) GTEST_SKIP() << "no ray queries";
    const std::vector<SceneInstance> moved{
        {},
        {0, glm::mat4x3(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0.3f, 0, 0))}};
    for (const std::vector<SceneInstance>& instances : {std::vector<SceneInstance>{{}}, moved})
        for (const bool normals : {false, true}) {
            const GpuScene pipeline = scene({.normals = normals}, instances);
            const GpuScene query = scene({.normals = normals, .traversal = Traversal::query}, instances);
            EXPECT_EQ(query.cost().traversal, Traversal::query);
            expect_same(pipeline.trace(rays).hits, query.trace(rays).hits);
            const Hits pipeline_shadow = pipeline.trace(rays, {.shadow = true}).hits;
            const Hits query_shadow = query.trace(rays, {.shadow = true}).hits;
            for (size_t i = 0; i < rays.rays.size(); ++i)
                EXPECT_EQ(pipeline_shadow.hits[i].is_hit(), query_shadow.hits[i].is_hit()) << i;
        }
}

TEST_P(TraversalTest, PicturesOfAnyShapeAreTracedWhole) {
    const GpuScene pipeline = scene({}),
                   query = scene(
                       {.traversal = device().can_query_rays() ? Traversal::query : Traversal::pipeline});
    for (const uint32_t width : {1u, 13u, 16u, 27u}) {
        Rays picture = rays;
        picture.rays.resize(picture.rays.size() / width * width);
        const Hits list = pipeline.trace(picture).hits;
        picture.width = width;
        picture.height = static_cast<uint32_t>(picture.rays.size() / width);
        expect_same(list, pipeline.trace(picture).hits);
        expect_same(list, query.trace(picture).hits);
    }
}

TEST_P(TraversalTest, AutomaticChoosesTheFasterOfWhatItMeasured) {
    const GpuScene automatic = scene({.traversal = Traversal::automatic});
    expect_same(scene({}).trace(rays).hits, automatic.trace(rays).hits);
    if (!device().can_query_rays()) {
        EXPECT_EQ(automatic.cost().traversal, Traversal::pipeline);
        return;
    }
    ASSERT_TRUE(automatic.cost().traversal_times.has_value());
    EXPECT_EQ(automatic.cost().traversal, automatic.cost().traversal_times->faster());
}

TEST_P(TraversalTest, InstrumentedShadersCountLeavesAndReports) {
    for (const Traversal traversal : {Traversal::pipeline, Traversal::query}) {
        if (traversal == Traversal::query && !device().can_query_rays()) continue;
        const GpuScene traced = scene({.traversal = traversal});
        GpuRays buffers(device(), rays, false);
        traced.run(buffers, false);
        const Hits before = buffers.hits();
        const auto work = traced.count_work(buffers, false);
        expect_same(before, buffers.hits());
        const bool has_intersector = !choice.primitive->shaders.intersection.empty();
        ASSERT_EQ(work.has_value(), has_intersector);
        EXPECT_EQ(traced.run_floor(buffers, false).has_value(), has_intersector);
        if (!has_intersector) continue;
        ASSERT_EQ(work->size(), rays.rays.size());
        for (size_t i = 0; i < work->size(); ++i) {
            const RayWork& ray = (*work)[i];
            EXPECT_EQ(ray.reports > 0, before.hits[i].is_hit()) << i;
            EXPECT_LE(ray.reports, ray.leaves) << i;
            EXPECT_LE(ray.searched, ray.leaves) << i;
            EXPECT_LE(ray.searched, ray.iterations) << i;
        }
        EXPECT_EQ(sum_of(*work).iterations > 0, choice.primitive->cpu.counted != nullptr);
    }
}

INSTANTIATE_TEST_SUITE_P(Primitives, TraversalTest, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace strandlab
