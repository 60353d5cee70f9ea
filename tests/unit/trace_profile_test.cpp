// What a profile counts, on the processor: rows with one have its fields.
#include "measure/trace_profile.h"

#include "report/profile_table.h"
#include "report/result_csv.h"
#include "report/row_fields.h"
#include "strands/generators.h"
#include "support/result_rows.h"
#include "trace/cpu_trace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strandlab {
namespace {

/// Rays that pass near the curves from one side.
MeasuredRays rays_at(const Curves& curves) {
    MeasuredRays rays;
    for (size_t i = 0; i < 2000; ++i) {
        const glm::vec4 p = curves.curves[(7 * i) % curves.curves.size()][1 + i % 2];
        const glm::vec3 direction(1, 0.01f * float(i % 7), 0.3f);
        const glm::vec3 aside = 0.3f * p.w * float(i % 5) * glm::vec3(0, 0, 1);
        rays.rays.rays.push_back({glm::vec3(p) + aside - 2.0f * direction, 0.0f, direction, 1e30f});
    }
    return rays;
}

class TraceProfileTest : public testing::TestWithParam<const char*> {
  protected:
    const TraceDevice device_{{.selector = "cpu-float"}};
    const Scene scene_ = scene_of("fur", generate("generate:fur,strands=3000"));
    const Curves curves_ = all_curves(scene_);
    const PrimitiveChoice choice_ = parse_primitive(GetParam());
    const CaseInput input_{device_, scene_, curves_, 2, 0, {.ray_extent = 3}};
};

TEST_P(TraceProfileTest, CountsWhatTheKernelsDo) {
    const MeasuredRays rays = rays_at(curves_);
    const PreparedCase prepared = prepare_case(input_, choice_);
    const TraceProfile profile = profile_of(input_, *prepared.traced, rays, 1);
    ASSERT_TRUE(profile.work && profile.work_at_hit && profile.floor_ms && profile.floor_at_hit_ms);
    EXPECT_GT(profile.hits, 0u);
    EXPECT_EQ(profile.work->rays, rays.rays.rays.size());
    EXPECT_GE(profile.work->reports, profile.hits);
    EXPECT_EQ(profile.work_at_hit->reports > 0, true);
    EXPECT_GE(profile.work->leaves, profile.work->reports);
    EXPECT_LE(profile.work_at_hit->leaves, profile.work->leaves);
    EXPECT_EQ(profile.work->iterations > 0, choice_.primitive->cpu.counted != nullptr);
    EXPECT_EQ(profile.work->searched > 0, choice_.primitive->cpu.counted != nullptr);

    // The same ray by ray.
    const Geometry geometry = choice_.primitive->build(curves_, choice_.options);
    const CpuTracer tracer(geometry, *choice_.primitive, Precision::single, 3);
    uint64_t walked = 0;
    WorkCounts sum;
    for (const Ray& ray : rays.rays.rays) {
        sum.add(tracer.work(ray));
        walked += tracer.walk(ray);
    }
    EXPECT_EQ(sum.leaves, profile.work->leaves);
    EXPECT_EQ(sum.reports, profile.work->reports);
    EXPECT_EQ(sum.iterations, profile.work->iterations);
    EXPECT_GE(walked, sum.leaves);  // whole rays come upon every leaf along them
}

TEST_P(TraceProfileTest, StandsInRows) {
    const MeasuredRays rays = rays_at(curves_);
    const PreparedCase prepared = prepare_case(input_, choice_);
    ResultRow row = testing_tools::result_row(GetParam(), 5, 100, 0.01);
    const auto without = to_json(row);
    EXPECT_TRUE(without["profile"].is_null());
    EXPECT_EQ(profile_table({&without, 1}), "");
    row.profile = profile_of(input_, *prepared.traced, rays, 1);
    const auto json = to_json(row);
    EXPECT_EQ(number_at(json, "profile.work.leaves_per_ray"), row.profile->work->leaves_per_ray());
    EXPECT_EQ(number_at(json, "profile.hits"), double(row.profile->hits));
    const std::string table = profile_table({&json, 1});
    EXPECT_NE(table.find("leaves"), std::string::npos);
    EXPECT_NE(table.find(GetParam()), std::string::npos);
    const auto& columns = csv_columns();
    const auto column = std::find(columns.begin(), columns.end(), "profile.work.false_entry_share");
    ASSERT_NE(column, columns.end());
    EXPECT_FALSE(csv_fields(json)[static_cast<size_t>(column - columns.begin())].empty());
}

INSTANTIATE_TEST_SUITE_P(Primitives, TraceProfileTest, testing::Values("lss", "prhi", "rocaps", "dots"),
                         [](const auto& test) { return std::string(test.param); });

TEST(TraceProfile, ShadowRaysHaveNoFloorAtTheirHits) {
    const TraceDevice device({.selector = "cpu-float"});
    const Scene scene = scene_of("fur", generate("generate:fur,strands=300"));
    const Curves curves = all_curves(scene);
    const CaseInput input{device, scene, curves, 1, 0, {.ray_extent = 3}};
    MeasuredRays rays = rays_at(curves);
    rays.shadow = true;
    const PreparedCase prepared = prepare_case(input, parse_primitive("prhi"));
    const TraceProfile profile = profile_of(input, *prepared.traced, rays, 1);
    EXPECT_TRUE(profile.work.has_value());
    EXPECT_FALSE(profile.work_at_hit.has_value());
    EXPECT_FALSE(profile.floor_at_hit_ms.has_value());
}

}  // namespace
}  // namespace strandlab
