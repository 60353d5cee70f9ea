// Rows against those of an earlier run: nothing found where nothing changed, everything where something did.
#include "report/baseline.h"

#include "base/random.h"
#include "measure/bench_case.h"
#include "measure/interleave.h"
#include "primitives/curved_pieces.h"
#include "report/result_json.h"
#include "trace/cpu_trace.h"
#include "trace/ray_sets.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>

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

/// A few strands with rays that start among them, for the C++ versions.
class FewStrands {
  public:
    explicit FewStrands(size_t rays) : scene_(scene_of("few", strands())), device_({"cpu-float", false}) {
        rays_.rays = interior_rays(scene_.models[0], rays, 5);
        input_.options.normals = true;
        input_.options.ray_extent = 5;
    }

    /// The row of a primitive's errors in place of those of lss.
    Json row_with_errors(const Primitive& primitive) {
        rays_.sample = error_sample(rays_.rays.rays.size(), rays_.rays.rays.size());
        rays_.sample_rays = selected(rays_.rays, rays_.sample);
        const std::vector<Surface> common = common_surfaces(scene_, Caps::round);
        rays_.common = make_scene_reference(scene_, common, scene_.models[0], rays_.sample_rays);
        PrimitiveChoice choice = parse_primitive("lss:segments=16");
        choice.primitive = &primitive;
        const PreparedCase prepared = prepare_case(input_, choice);
        const Hits hits = prepared.traced->trace(rays_.rays, {}).hits;
        CaseErrors errors = errors_of(input_, choice, rays_, selected(hits, rays_.sample));
        ResultRow row = row_of("lss:segments=16", 1, 1);
        row.intersector_error = errors.own;
        row.model_error = errors.model;
        return to_json(row);
    }

    /// The row of real times of prhi, whose work on every ray is done `times` over, beside lss.
    Json row_with_times(int times) const {
        const PreparedCase lss = prepare_case(input_, parse_primitive("lss"));
        const PreparedCase prhi = prepare_case(input_, parse_primitive("prhi"));
        const auto buffers = device_.upload(rays_.rays, true);
        const std::vector<std::function<double()>> traces{[&] { return lss.traced->run(*buffers, false); },
                                                          [&] {
                                                              double sum = 0;
                                                              for (int i = 0; i < times; ++i)
                                                                  sum += prhi.traced->run(*buffers, false);
                                                              return sum;
                                                          }};
        const std::vector<TimeSamples> samples = interleave(traces, {.rounds = 15});
        ResultRow row = row_of("prhi", 1, 1);
        row.trace_ms = samples[1].device_ms;
        row.ratio = TimeRatio{"lss", {}};
        for (size_t i = 0; i < row.trace_ms.size(); ++i)
            row.ratio->samples.push_back(row.trace_ms[i] / samples[0].device_ms[i]);
        return to_json(row);
    }

  private:
    static Curves strands() {
        Curves curves;
        for (uint32_t s = 0; s < 40; ++s) {
            const auto x = static_cast<float>(s) * 0.1f;
            Curve curve;
            for (int k = 0; k < 4; ++k)
                curve[k] = glm::vec4(x + 0.02f * float(k * k % 3), 0.3f * float(k), 0, 0.02f);
            curves.curves.push_back(curve);
            curves.strands.push_back({s, 1});
        }
        return curves;
    }

    Scene scene_;
    TraceDevice device_;
    MeasuredRays rays_;
    CaseInput input_{device_, scene_, scene_.models[0]};
};

TEST(Baseline, FindsAPrimitiveWhoseRadiusIsOnePercentOff) {
    const Primitive& right = primitive_named("lss");
    Primitive wrong = right;
    wrong.build = thickened<1>;
    FewStrands strands(3000);
    const std::vector<Json> before{strands.row_with_errors(right)}, again{strands.row_with_errors(right)},
        now{strands.row_with_errors(wrong)};
    EXPECT_FALSE(compare_with_baseline(again, before).is_worse());
    const BaselineComparison comparison = compare_with_baseline(now, before);
    EXPECT_TRUE(mentions(comparison.worse, "intersector_error")) << to_text(comparison);
    EXPECT_TRUE(mentions(comparison.worse, "model_error")) << to_text(comparison);
}

TEST(Baseline, FindsTwiceTheWorkInRealTimes) {
    if (std::getenv("STRANDLAB_LONG_TESTS") == nullptr)
        GTEST_SKIP() << "rests on real times: only with STRANDLAB_LONG_TESTS";
    const FewStrands strands(50'000);
    const std::vector<Json> before{strands.row_with_times(1)}, again{strands.row_with_times(1)},
        now{strands.row_with_times(2)};
    const BaselineComparison same = compare_with_baseline(again, before);
    EXPECT_EQ(same.times, 1u);
    EXPECT_FALSE(same.is_worse()) << to_text(same);
    const BaselineComparison slower = compare_with_baseline(now, before);
    EXPECT_TRUE(mentions(slower.worse, "prhi: slower, ")) << to_text(slower);
}

}  // namespace
}  // namespace strandlab
