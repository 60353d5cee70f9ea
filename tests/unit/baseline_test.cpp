// Rows against those of an earlier run: nothing found where nothing changed, everything where something did.
#include "report/baseline.h"

#include "base/random.h"
#include "measure/bench_case.h"
#include "primitives/curved_pieces.h"
#include "report/result_json.h"
#include "trace/cpu_trace.h"
#include "trace/ray_sets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// Times of ten rounds around a median, relative to those of "dots".
TimeRatio times(double median, uint64_t seed) {
    TimeRatio ratio{"dots", {}};
    for (size_t i = 0; i < 10; ++i)
        ratio.samples.push_back(median * std::exp(0.05 * Random(seed, 0, i).signed_unit()));
    return ratio;
}

ResultRow row_of(const char* primitive, double time, uint64_t seed) {
    ResultRow row;
    row.model = {"tuft", 0xABC, 10, 5};
    row.rays.name = "primary";
    row.primitive = facts_of(parse_primitive(primitive), Caps::round);
    row.device.name = "llvmpipe";
    row.ratio = times(time, seed);
    row.trace_ms = row.ratio->samples;
    Comparison& error = row.model_error.emplace();
    error.all.rays = 100;
    error.all.false_miss = {3, 50, 7};
    error.all.measures[0] = {40, 0.001, 0.002, 0.003, 0.004, 0.005, 12};
    return row;
}

/// A sweep of twelve primitives, its times drawn from the seed.
std::vector<Json> sweep(uint64_t seed) {
    std::vector<Json> rows;
    for (int i = 0; i < 12; ++i)
        rows.push_back(to_json(row_of(fmt::format("prhi:variant=published,iterations={}", i + 1).c_str(),
                                      1 + 0.1 * i, seed * 100 + static_cast<uint64_t>(i))));
    return rows;
}

bool mentions(const std::vector<std::string>& lines, std::string_view text) {
    for (const std::string& line : lines)
        if (line.find(text) != std::string::npos) return true;
    return false;
}

TEST(Baseline, FindsNoDifferenceBetweenTwoRunsOfOneSweep) {
    for (uint64_t seed = 2; seed < 40; ++seed) {
        const BaselineComparison comparison = compare_with_baseline(sweep(seed), sweep(1));
        EXPECT_EQ(comparison.rows, 12u);
        EXPECT_EQ(comparison.times, 12u);
        EXPECT_FALSE(comparison.is_worse()) << to_text(comparison);
        EXPECT_TRUE(comparison.better.empty()) << to_text(comparison);
        EXPECT_NE(to_text(comparison).find("no difference"), std::string::npos);
    }
}

TEST(Baseline, FindsTheRowThatIsSlower) {
    std::vector<Json> rows = sweep(2);
    rows[4] = to_json(row_of("prhi:variant=published,iterations=5", 2 * 1.4, 99));
    const BaselineComparison comparison = compare_with_baseline(rows, sweep(1));
    ASSERT_EQ(comparison.worse.size(), 1u) << to_text(comparison);
    EXPECT_TRUE(mentions(comparison.worse, "iterations=5: slower, "));
    const BaselineComparison other_way = compare_with_baseline(sweep(1), rows);
    EXPECT_FALSE(other_way.is_worse());
    EXPECT_TRUE(mentions(other_way.better, "iterations=5: faster, "));
}

TEST(Baseline, PairsPrimitivesOfOtherParametersWhereItIsClear) {
    // Twice the iterations through a parameter: another label, another key.
    const std::vector<Json> before{to_json(row_of("dots", 1, 1)),
                                   to_json(row_of("prhi:variant=published", 2, 2))};
    const std::vector<Json> now{to_json(row_of("dots", 1, 3)),
                                to_json(row_of("prhi:variant=published,iterations=16", 3.7, 4))};
    const BaselineComparison comparison = compare_with_baseline(now, before);
    EXPECT_EQ(comparison.rows, 2u);
    EXPECT_EQ(comparison.times, 1u);  // dots is the control row
    ASSERT_EQ(comparison.worse.size(), 1u) << to_text(comparison);
    EXPECT_TRUE(mentions(comparison.worse, "iterations=16 (was prhi:variant=published): slower"));
}

TEST(Baseline, ComparesErrorsExactly) {
    std::vector<Json> rows = sweep(1);
    rows[2]["model_error"]["all"]["false_miss"]["count"] = 4;
    rows[3]["model_error"]["all"]["distance"]["p99"] = std::nextafter(0.003, 1.0);
    rows[5]["model_error"]["all"]["distance"]["p99"] = 0.0029;
    rows[6]["model_error"]["all"]["distance"]["max"] = "inf";
    const BaselineComparison comparison = compare_with_baseline(rows, sweep(1));
    EXPECT_EQ(comparison.worse.size(), 3u) << to_text(comparison);
    EXPECT_TRUE(mentions(comparison.worse, "all.false_miss.count 4 was 3"));
    EXPECT_TRUE(mentions(comparison.worse, "all.distance.max inf was 0.005"));
    ASSERT_EQ(comparison.better.size(), 1u);
    EXPECT_TRUE(mentions(comparison.better, "all.distance.p99"));
}

TEST(Baseline, OtherCurvesOrRaysAreADifference) {
    std::vector<Json> rows = sweep(1);
    ResultRow row = row_of("prhi:variant=published,iterations=3", 1.2, 102);
    row.model.hash = 0xDEF;
    rows[2] = to_json(row);
    const BaselineComparison comparison = compare_with_baseline(rows, sweep(1));
    ASSERT_EQ(comparison.worse.size(), 1u) << to_text(comparison);
    EXPECT_TRUE(
        mentions(comparison.worse, "the curves changed: \"0000000000000def\" was \"0000000000000abc\""));
}

TEST(Baseline, SaysWhatItCouldNotCompare) {
    std::vector<Json> rows = sweep(1);
    rows.push_back(to_json(row_of("lss", 1, 1)));
    std::vector<Json> before = sweep(1);
    before.push_back(to_json(row_of("dots", 1, 1)));
    ResultRow other = row_of("prhi:variant=published,iterations=1", 1, 100);
    other.ratio->baseline = "lss";
    before[0] = to_json(other);
    const BaselineComparison comparison = compare_with_baseline(rows, before);
    EXPECT_TRUE(mentions(comparison.notes, "1 rows have no partner"));
    EXPECT_TRUE(mentions(comparison.notes, "1 rows of the baseline were not measured"));
    EXPECT_TRUE(mentions(comparison.notes, "no baseline primitive in both files"));
    EXPECT_FALSE(comparison.is_worse()) << to_text(comparison);
    // Rows of other programs.
    const std::vector<Json> strange{Json::object(), Json{{"key", 3}, {"time", "x"}}};
    EXPECT_FALSE(compare_with_baseline(strange, sweep(1)).is_worse());
}

/// lss whose boxes and records are of strands that are thicker than the surface that it promises.
template <int percent>
Geometry thickened(const Curves& curves, const BuildOptions& options) {
    Curves thick = curves;
    for (Curve& curve : thick.curves)
        for (int i = 0; i < 4; ++i) curve[i].w *= 1 + 0.01f * percent;
    return primitive_named("lss").build(thick, options);
}

/// The row of such a primitive on a few strands, by the C++ version.
Json traced_row(const Primitive& primitive) {
    Curves curves;
    for (uint32_t s = 0; s < 40; ++s) {
        const auto x = static_cast<float>(s) * 0.1f;
        Curve curve;
        for (int k = 0; k < 4; ++k)
            curve[k] = glm::vec4(x + 0.02f * float(k * k % 3), 0.3f * float(k), 0, 0.02f);
        curves.curves.push_back(curve);
        curves.strands.push_back({s, 1});
    }
    const Scene scene = scene_of("few", curves);
    MeasuredRays rays;
    rays.rays = interior_rays(curves, 3000, 5);
    rays.sample = error_sample(rays.rays.rays.size(), 3000);
    rays.sample_rays = selected(rays.rays, rays.sample);
    const std::vector<Surface> common = common_surfaces(scene, Caps::round);
    rays.common = make_scene_reference(scene, common, curves, rays.sample_rays);
    const TraceDevice device({"cpu-float", false});
    CaseInput input{device, scene, curves};
    input.options.normals = true;
    input.options.ray_extent = 5;
    PrimitiveChoice choice = parse_primitive("lss:segments=16");
    choice.primitive = &primitive;
    const PreparedCase prepared = prepare_case(input, choice);
    const Hits hits = prepared.traced->trace(rays.rays, {}).hits;
    CaseErrors errors = errors_of(input, choice, rays, selected(hits, rays.sample));
    ResultRow row = row_of("lss:segments=16", 1, 1);
    row.intersector_error = errors.own;
    row.model_error = errors.model;
    return to_json(row);
}

TEST(Baseline, FindsAPrimitiveWhoseRadiusIsOnePercentOff) {
    const Primitive& right = primitive_named("lss");
    Primitive wrong = right;
    wrong.build = thickened<1>;
    const std::vector<Json> before{traced_row(right)}, again{traced_row(right)}, now{traced_row(wrong)};
    EXPECT_FALSE(compare_with_baseline(again, before).is_worse());
    const BaselineComparison comparison = compare_with_baseline(now, before);
    EXPECT_TRUE(mentions(comparison.worse, "intersector_error")) << to_text(comparison);
    EXPECT_TRUE(mentions(comparison.worse, "model_error")) << to_text(comparison);
}

}  // namespace
}  // namespace strandlab
