// Stress pairs on the device: every ray meets its own strand, and what the device says is what the C++ float
// version says.
#include "gpu_fixture.h"
#include "measure/stress_limits.h"

namespace strandlab {
namespace {

class StressOnDevice : public GpuTest, public testing::WithParamInterface<std::string> {};

TEST_P(StressOnDevice, AgreesWithTheFloatVersion) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    // More pairs than one structure takes; strands of one curve and of three; strands without any leaf.
    for (const char* name : {"gentle", "joints", "far 1e4", "offset 1e4", "short rays", "point"}) {
        const StressRange range{&stress_family(name), default_stress_seed, 0, 700};
        const Curves strands = stress_strands(range);
        const StressPairs pairs = stress_pairs(range, choice.primitive->surface(strands, choice.options));
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        StressTally tally;
        const auto plain =
            intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, tally.boxes);
        const PairScene scene(device(), *choice.primitive, geometry, range,
                              {.extent = extent_of(pairs.rays)});
        const std::vector<StressHit> hits = scene.trace(pairs.rays);
        ASSERT_EQ(hits.size(), plain.size());
        Agreement agreement;
        add_difference(strands, pairs.rays, hits, plain, agreement);
        EXPECT_EQ(agreement.pairs, range.count);
        // The driver's own triangle test rounds otherwise than ours, the more the farther the ray begins.
        const bool triangles = geometry.is_triangles();
        EXPECT_LE(agreement.beyond(), triangles ? range.count / 10 : 0u) << name;
        EXPECT_LE(agreement.only_cpu, triangles ? range.count / 50 : 0u) << name;
    }
}

TEST_P(StressOnDevice, AgreesInEveryFamily) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    PipelineStore pipelines;
    for (const StressFamily& family : stress_families()) {
        const StressRange range{&family, default_stress_seed, 0, 200};
        const Curves strands = stress_strands(range);
        const StressPairs pairs = aimed_pairs(range, choice.primitive->surface(strands, choice.options));
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        BoxCheck boxes;
        const auto plain = intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, boxes);
        const PairScene scene(device(), *choice.primitive, geometry, range,
                              {.extent = extent_of(pairs.rays), .pipelines = &pipelines});
        Agreement agreement;
        add_difference(strands, pairs.rays, scene.trace(pairs.rays), plain, agreement);
        const StressJudgement judgement = judge_agreement(agreement, choice, family);
        EXPECT_NE(judgement.verdict, StressVerdict::fails) << family.name << ": " << judgement.text;
    }
}

TEST_P(StressOnDevice, RaysLeaveHitsAndShadowRaysAgree) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    PipelineStore pipelines;
    for (const char* name : {"gentle", "joints", "kinks", "fat curl", "r/L=1e-3", "structured"}) {
        const StressRange range{&stress_family(name), default_stress_seed, 0, 300};
        const Curves strands = stress_strands(range);
        const Surface surface = choice.primitive->surface(strands, choice.options);
        const StressPairs pairs = aimed_pairs(range, surface);
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        const auto points = spawn_points(*choice.primitive, geometry, surface, pairs);
        const PairScene scene(device(), *choice.primitive, geometry, range, {.pipelines = &pipelines});
        SpawnTally tally;
        add_spawned(scene, *choice.primitive, surface, range, points, tally);
        EXPECT_GE(tally.rays, 100u) << name;
        EXPECT_EQ(tally.shadow_rays, tally.rays) << name;
        EXPECT_EQ(tally.shadow_differs, 0u) << name;
        EXPECT_EQ(tally.self_hits, 0u) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Primitives, StressOnDevice,
                         testing::Values("lss", "rocaps", "prhi", "dots", "lss:segments=1"),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace strandlab
