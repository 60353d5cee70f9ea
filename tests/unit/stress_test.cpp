// The families of stress pairs, and that the suite sees the errors it is made to see.
#include "measure/stress.h"

#include "strands/bezier.h"
#include "unit/support/stress_tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace strandlab {
namespace {

/// Enough for rates of a few in a thousand.
constexpr uint64_t pair_count = 1500;

StressTally tally_of(const std::string& label, const StressFamily& family, Precision precision,
                     uint64_t count = pair_count) {
    return testing_tools::tally_of(label, family, precision, count);
}

StressVerdict verdict_of(const std::string& label, const std::string& name, Precision precision) {
    const StressFamily& family = stress_family(name);
    return testing_tools::verdict_of(label, family, precision, tally_of(label, family, precision));
}

TEST(Stress, FamiliesHaveDecisiveHitsAndMisses) {
    for (const StressFamily& family : stress_families()) {
        if (!family.is_resolvable()) continue;
        SCOPED_TRACE(family.name);
        const StressTally tally = tally_of("lss", family, Precision::single);
        // Rays that start inside hit by exception.
        if (!family.inside || family.returns) {
            EXPECT_GE(double(tally.hits), 0.15 * double(tally.pairs));
        }
        EXPECT_GE(double(tally.misses), 0.1 * double(tally.pairs));
        EXPECT_LE(tally.margin.quantile(0.5), largest_stress_margin);
    }
}

TEST(Stress, UnresolvableFamiliesAreSo) {
    for (const StressFamily& family : stress_families()) {
        if (family.is_resolvable()) continue;
        const StressTally tally = tally_of("rocaps", family, Precision::single, 200);
        EXPECT_GT(tally.margin.quantile(0.5), largest_stress_margin) << family.name;
        EXPECT_EQ(judge(tally, stress_limits("rocaps", family, false), family, false).verdict,
                  StressVerdict::not_judged);
    }
}

TEST(Stress, PairsAreTheSameWhicheverRangeTheyAreIn) {
    const PrimitiveChoice choice = parse_primitive("lss");
    for (const char* name : {"gentle", "kinks", "stretched", "short rays"}) {
        const auto pairs = [&](uint64_t first, uint64_t count) {
            const StressRange range{&stress_family(name), 7, first, count};
            return stress_pairs(range, choice.primitive->surface(stress_strands(range), choice.options));
        };
        const StressPairs all = pairs(0, 60), part = pairs(40, 20);
        for (size_t i = 0; i < 20; ++i) {
            EXPECT_EQ(std::memcmp(&all.rays[40 + i], &part.rays[i], sizeof(Ray)), 0) << name << " " << i;
            EXPECT_EQ(all.answers[40 + i].t, part.answers[i].t) << name << " " << i;
        }
        const Ray other = make_ray(stress_family(name), 8, 40);
        EXPECT_NE(std::memcmp(&other, &all.rays[40], sizeof(Ray)), 0) << name;
    }
}

TEST(Stress, RobustPrimitivesHoldOnOrdinaryFamilies) {
    for (const char* primitive : {"lss", "rocaps", "prhi"})
        for (const char* family :
             {"gentle", "curl", "hard taper", "joints", "near-parallel", "grazing", "short rays", "stretched",
              "mirrored", "axis-aligned", "r/L=1e-4", "far 1e4", "offset 1e6", "unit 1e-6", "unit 1e9"})
            for (const Precision precision : {Precision::single, Precision::precise})
                EXPECT_EQ(verdict_of(primitive, family, precision), StressVerdict::holds)
                    << primitive << " " << family << (precision == Precision::precise ? " double" : " float");
}

TEST(Stress, TheLimitsOfAVerdictAreItsBounds) {
    const StressFamily& family = stress_family("gentle");
    StressTally tally;
    tally.hits = 1000, tally.misses = 1000, tally.pairs = 2000;
    const StressLimits limits{1e-3, 0, 0, 1, 1};
    tally.false_misses = 2;  // compatible with 1e-3
    EXPECT_EQ(judge(tally, limits, family, false).verdict, StressVerdict::holds);
    tally.false_misses = 8;
    EXPECT_EQ(judge(tally, limits, family, false).verdict, StressVerdict::fails);
    tally.false_misses = 0, tally.false_hits = 1;  // none is allowed
    EXPECT_EQ(judge(tally, limits, family, false).verdict, StressVerdict::fails);
    tally.false_hits = 0, tally.nan_hits = 1;
    EXPECT_EQ(judge(tally, limits, family, false).verdict, StressVerdict::fails);
    tally.nan_hits = 0;
    EXPECT_EQ(judge(tally, std::nullopt, family, false).verdict, StressVerdict::not_judged);
}

TEST(Stress, IterationsAreCountedAndChangeNothing) {
    for (const char* label : {"prhi", "prhi:variant=published", "rocaps", "rocaps:variant=published"}) {
        const PrimitiveChoice choice = parse_primitive(label);
        const StressRange range{&stress_family("curl"), default_stress_seed, 0, 500};
        const Curves strands = stress_strands(range);
        const StressPairs pairs = aimed_pairs(range, choice.primitive->surface(strands, choice.options));
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        uint64_t sum = 0;
        for (size_t leaf = 0; leaf < geometry.leaf_count(); ++leaf) {
            const Ray& ray = pairs.rays[geometry.leaves[leaf].curve];
            LeafHit<float> plain, counted;
            uint32_t iterations = 0;
            const bool found = choice.primitive->cpu.single(geometry, leaf, ray, ray.tmax, plain);
            ASSERT_EQ(choice.primitive->cpu.counted(geometry, leaf, ray, ray.tmax, counted, iterations),
                      found);
            if (found) {
                EXPECT_EQ(plain.t, counted.t);
                EXPECT_GE(iterations, 1u) << label;
            }
            sum += iterations;
        }
        IterationHistogram histogram;
        count_iterations(*choice.primitive, geometry, pairs, histogram);
        EXPECT_EQ(histogram.count(), range.count) << label;
        EXPECT_LE(histogram.mean() * double(range.count), double(sum)) << label;  // hits shorten the ray
        EXPECT_GT(histogram.mean(), 1) << label;
        EXPECT_GE(histogram.max(), histogram.quantile(0.99)) << label;
    }
    IterationHistogram none;
    const PrimitiveChoice lss = parse_primitive("lss");
    count_iterations(*lss.primitive, {}, {}, none);
    EXPECT_EQ(none.count(), 0u);
}

TEST(Stress, HitsWhereDiscsOverlapAreCountedApart) {
    const StressTally tally = tally_of("prhi", stress_family("fat curl"), Precision::single);
    EXPECT_GT(tally.folded, pair_count / 10);
    EXPECT_GT(tally.folded_errors, 10u);
    EXPECT_EQ(tally.pairs, tally.hits + tally.misses + tally.folded + tally.undecided());
    EXPECT_EQ(tally_of("prhi", stress_family("gentle"), Precision::single).folded, 0u);
    EXPECT_EQ(tally_of("rocaps", stress_family("fat curl"), Precision::single).folded, 0u);
}

TEST(Stress, TheWorstPairsAreKeptInOrder) {
    const StressTally tally =
        tally_of("rocaps:variant=published", stress_family("far 1e6"), Precision::single, 500);
    ASSERT_EQ(tally.worst.size(), 3u);
    EXPECT_GE(tally.worst[0].error, tally.worst[1].error);
    EXPECT_GE(tally.worst[1].error, tally.worst[2].error);
    EXPECT_LT(tally.worst[0].index, 500u);
}

TEST(IterationHistogram, IsExact) {
    IterationHistogram histogram;
    EXPECT_EQ(histogram.quantile(0.5), 0u);
    EXPECT_TRUE(histogram.counts().empty());
    for (uint32_t i = 1; i <= 100; ++i) histogram.add(i);
    EXPECT_EQ(histogram.quantile(0.5), 50u);
    EXPECT_EQ(histogram.quantile(0.99), 99u);
    EXPECT_EQ(histogram.mean(), 50.5);
    EXPECT_EQ(histogram.counts().size(), 101u);
    histogram.add(5000);
    EXPECT_EQ(histogram.max(), 5000u);
    EXPECT_EQ(histogram.quantile(1), 5000u);
}

TEST(LogHistogram, QuantilesAreTheValuesAlmost) {
    LogHistogram histogram;
    EXPECT_EQ(histogram.quantile(0.5), 0);
    for (int i = 1; i <= 1000; ++i) histogram.add(i * 1e-6);
    EXPECT_NEAR(histogram.quantile(0.5), 500e-6, 500e-6 * 0.025);
    EXPECT_NEAR(histogram.quantile(0.99), 990e-6, 990e-6 * 0.025);
    EXPECT_EQ(histogram.quantile(1), 1000e-6);
    EXPECT_LE(histogram.count_above(900e-6), 100u);
    EXPECT_GE(histogram.count_above(900e-6), 75u);
    histogram.add(0);
    EXPECT_EQ(histogram.quantile(0), 0);
    histogram.add(1e300);
    EXPECT_EQ(histogram.max(), 1e300);
    EXPECT_EQ(histogram.octave(59), 1u);
    EXPECT_EQ(histogram.octave(-60), 1u);   // the 0
    EXPECT_EQ(histogram.octave(-10), 24u);  // 977 to 1000 of a million
    uint64_t sum = 0;
    for (int e = LogHistogram::first_octave; e < LogHistogram::last_octave; ++e) sum += histogram.octave(e);
    EXPECT_EQ(sum, histogram.count());
}

}  // namespace
}  // namespace strandlab
