#include "unit/support/comparison_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace strandlab::testing {
namespace {

TEST(Comparison, PerfectResultHasNoError) {
    Case c;
    c.add();
    c.add(false);
    const Tally& tally = c.result().decisive;
    EXPECT_EQ(tally.rays, 2u);
    EXPECT_EQ(tally.matches, 1u);
    EXPECT_EQ(tally.agreed_misses, 1u);
    EXPECT_FALSE(tally.has_errors());
    for (const Measure m : {Measure::distance, Measure::ulps, Measure::strand_u, Measure::offset,
                            Measure::normal, Measure::tangent}) {
        EXPECT_EQ(tally.of(m).count, 1u) << measure_infos[static_cast<size_t>(m)].name;
        EXPECT_EQ(tally.of(m).max, 0) << measure_infos[static_cast<size_t>(m)].name;
    }
    EXPECT_EQ(tally.of(Measure::residual).count, 0u);
}

TEST(Comparison, FalseHitIsCountedPerReferenceMiss) {
    Case c;
    c.add(false);
    c.hits[c.add(false)] = {1, 0.5f, 0, 0};
    c.add();
    const Comparison result = c.result();
    EXPECT_EQ(result.decisive.false_hit.count, 1u);
    EXPECT_EQ(result.decisive.false_hit.trials, 2u);
    EXPECT_EQ(result.decisive.false_hit.first_ray, 1u);
    EXPECT_EQ(result.decisive.false_miss.trials, 1u);
    EXPECT_EQ(result.decisive.matches, 1u);
    EXPECT_LT(result.decisive.false_hit.bounds().low, 0.5);
}

TEST(Comparison, FalseMissIsCountedPerReferenceHit) {
    Case c;
    c.hits[c.add()] = Hit();
    c.add();
    c.add(false);
    const Tally& tally = c.result().decisive;
    EXPECT_EQ(tally.false_miss.count, 1u);
    EXPECT_EQ(tally.false_miss.trials, 2u);
    EXPECT_EQ(tally.of(Measure::distance).count, 1u) << "a class is not averaged into the measures";
}

TEST(Comparison, WrongStrandInstanceOrUnknownCurve) {
    Case c;
    c.hits[c.add()].curve = 2;
    EXPECT_EQ(c.outcome(), Outcome::wrong_strand);
    c.hits[c.add()].instance = 1;
    EXPECT_EQ(c.outcome(), Outcome::wrong_strand);
    c.hits[c.add()].curve = 3;
    EXPECT_EQ(c.outcome(), Outcome::wrong_strand);
    c.hits[c.add()].curve = 1;
    EXPECT_EQ(c.outcome(), Outcome::match) << "another curve of the same strand";
    EXPECT_EQ(c.result().decisive.wrong_strand.count, 3u);
}

TEST(Comparison, WrongPlaceBeginsBeyondHalfTheRadius) {
    Case c;
    const size_t ray = c.add();
    const double t = c.reference[ray].t;
    c.hits[ray].t = static_cast<float>(t + 0.499 * static_cast<double>(radius));
    EXPECT_EQ(c.outcome(), Outcome::match);
    EXPECT_NEAR(c.error(Measure::distance), 0.499, 1e-5);
    c.hits[ray].t = static_cast<float>(t + 0.501 * static_cast<double>(radius));
    EXPECT_EQ(c.outcome(), Outcome::wrong_place);
    c.hits[ray].t = static_cast<float>(t - 0.501 * static_cast<double>(radius));
    EXPECT_EQ(c.outcome(), Outcome::wrong_place);
}

TEST(Comparison, WrongPlaceCountsInWorldUnitsForLongDirections) {
    Case c;
    const size_t ray = c.add();
    c.rays[ray].direction = {0, 0, -2};
    c.reference[ray].t /= 2;
    c.hits[ray].t =
        static_cast<float>(c.reference[ray].t + 0.4 * static_cast<double>(radius));  // 0.8 r in space
    EXPECT_EQ(c.outcome(), Outcome::wrong_place);
    c.hits[ray].t = static_cast<float>(c.reference[ray].t + 0.2 * static_cast<double>(radius));
    EXPECT_EQ(c.outcome(), Outcome::match);
    EXPECT_NEAR(c.error(Measure::distance), 0.4, 1e-5);
}

TEST(Comparison, AFarHitMayBeOffByEightUlps) {
    Case c;
    const size_t ray = c.add();
    const float far = 1e6f;  // spacing 0.0625: half a radius is far below one ulp
    c.reference[ray].t = static_cast<double>(far);
    c.hits[ray].t = far + 8 * 0.0625f;
    EXPECT_EQ(c.outcome(), Outcome::match);
    EXPECT_EQ(c.error(Measure::ulps), 8);
    c.hits[ray].t = far + 9 * 0.0625f;
    EXPECT_EQ(c.outcome(), Outcome::wrong_place);
}

TEST(Comparison, NanIsAClassAndNeverAMatch) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Case c;
    c.hits[c.add()].t = nan;
    EXPECT_EQ(c.outcome(), Outcome::nan);
    c.hits[c.add()].u = nan;
    EXPECT_EQ(c.outcome(), Outcome::nan);
    c.hits[c.add(false)].t = nan;
    EXPECT_EQ(c.outcome(), Outcome::nan);
    c.hits[c.add()].t = std::numeric_limits<float>::infinity();
    EXPECT_EQ(c.outcome(), Outcome::nan);
    c.reference[c.add()].radius = std::nan("");
    EXPECT_EQ(c.outcome(), Outcome::wrong_place) << "a bound that is NaN holds nothing";
    const Comparison result = c.result();
    EXPECT_EQ(result.decisive.nan.count, 4u);
    EXPECT_EQ(result.decisive.nan.trials, 5u);
}

TEST(Comparison, BadNormalsAreCountedNotMeasured) {
    Case c;
    c.normals[c.add()] = glm::vec3(0);
    c.normals[c.add()].x = std::numeric_limits<float>::quiet_NaN();
    c.normals[c.add()] = {0, 1, 1};
    const Tally& tally = c.result().decisive;
    EXPECT_EQ(tally.matches, 3u);
    EXPECT_EQ(tally.bad_normal.count, 2u);
    EXPECT_EQ(tally.bad_normal.trials, 3u);
    EXPECT_EQ(tally.of(Measure::normal).count, 1u);
    EXPECT_NEAR(tally.of(Measure::normal).max, 45, 1e-5);
}

TEST(Comparison, UndecidedPlacesAreJudgedByStrandAlone) {
    Case c;
    std::vector<uint8_t> decisive_place;
    const auto add = [&](uint8_t place) {
        c.add();
        decisive_place.push_back(place);
    };
    add(1);
    add(1);
    c.hits.back().t += 1;  // wrong place
    add(0);
    c.hits.back().t += 1;  // elsewhere on the right strand
    add(0);
    c.hits.back() = Hit();  // a miss is wrong wherever the hit is
    add(0);
    c.hits.back().curve = 2;
    add(0);
    ComparisonInput in = c.input();
    in.decisive_place = decisive_place;
    const Comparison result = compare(in);
    const Tally& t = result.decisive;
    EXPECT_EQ(t.rays, 6u);
    EXPECT_EQ(t.wrong_place.count, 1u);
    EXPECT_EQ(t.wrong_place.trials, 2u);
    EXPECT_EQ(t.wrong_place.first_ray, 1u);
    EXPECT_EQ(t.false_miss.count, 1u);
    EXPECT_EQ(t.false_miss.trials, 6u);
    EXPECT_EQ(t.wrong_strand.count, 1u);
    EXPECT_EQ(t.matches, 3u);
    EXPECT_EQ(t.of(Measure::distance).count, 1u);
    // What happened is seen in the group of all rays.
    EXPECT_EQ(result.all.rays, 6u);
    EXPECT_EQ(result.all.wrong_place.count, 2u);
    EXPECT_EQ(result.all.wrong_place.trials, 6u);
    EXPECT_EQ(result.undecided(), 0u);
}

TEST(Comparison, GroupsHoldEveryRayOnce) {
    Case c;
    c.add();
    c.decisive[c.add()] = 0;
    c.hits.back() = Hit();
    c.reference[c.add()].on_cap = true;
    c.hits.back().t += 1;
    c.reference[c.add()].starts_inside = true;
    c.reference.back().on_cap = true;
    c.reference[c.add(false)].starts_inside = true;
    const Comparison result = c.result();
    EXPECT_EQ(result.rays(), 5u);
    EXPECT_EQ(result.all.rays, 2u);
    EXPECT_EQ(result.decisive.rays, 1u);
    EXPECT_EQ(result.undecided(), 1u);
    EXPECT_EQ(result.undecided_share(), 0.5);
    EXPECT_FALSE(result.decisive.has_errors());
    EXPECT_EQ(result.all.false_miss.count, 1u);
    EXPECT_EQ(result.on_cap.rays, 1u);
    EXPECT_EQ(result.on_cap.wrong_place.count, 1u);
    EXPECT_EQ(result.inside.rays, 2u);
}

TEST(Comparison, LargeMarginsAreUnresolvable) {
    Case c;
    c.add();
    ComparisonInput in = c.input();
    in.margin = 1e-3;
    EXPECT_TRUE(compare(in).is_resolvable());
    in.margin = 0.11;
    EXPECT_FALSE(compare(in).is_resolvable());
    in.margin = std::nan("");
    EXPECT_FALSE(compare(in).is_resolvable());
}

TEST(Comparison, ShadowRaysCompareHitOrMissOnly) {
    Case c;
    c.hits[c.add()] = {std::nanf(""), std::nanf(""), 2, 9};
    c.hits[c.add(false)] = {1, 0, 2, 9};
    ComparisonInput in = c.input();
    in.hit_or_miss_only = true;
    in.curves = nullptr;
    const Comparison result = compare(in);
    EXPECT_TRUE(result.hit_or_miss_only);
    EXPECT_EQ(result.decisive.matches, 1u);
    EXPECT_EQ(result.decisive.false_hit.count, 1u);
    EXPECT_EQ(result.decisive.nan.count, 0u);
    EXPECT_EQ(result.decisive.of(Measure::distance).count, 0u);
}

TEST(Comparison, WithoutCurvesOnlyThePlaceCounts) {
    Case c;
    c.hits[c.add()].curve = 77;
    ComparisonInput in = c.input();
    in.knows_curves = false;
    in.curves = nullptr;
    const Comparison result = compare(in);
    EXPECT_EQ(result.decisive.matches, 1u);
    EXPECT_EQ(result.decisive.of(Measure::strand_u).count, 0u);
    EXPECT_EQ(result.decisive.of(Measure::distance).count, 1u);
}

TEST(Comparison, PercentilesAreExact) {
    Case c;
    // Ray i is off by (i * 7919 mod 10000) ulps of 1e6 (0.0625 each): all values 0 .. 9999 in a mixed order.
    for (uint32_t i = 0; i < 10000; ++i) {
        const size_t ray = c.add();
        c.reference[ray].t = 1e6;
        c.reference[ray].radius = 2000;
        c.hits[ray].t = 1e6f + 0.0625f * static_cast<float>(i * 7919 % 10000);
    }
    const Percentiles p = c.result().decisive.of(Measure::ulps);
    EXPECT_EQ(p.count, 10000u);
    EXPECT_EQ(p.p50, 4999);
    EXPECT_EQ(p.p95, 9499);
    EXPECT_EQ(p.p99, 9899);
    EXPECT_EQ(p.p999, 9989);
    EXPECT_EQ(p.max, 9999);
    EXPECT_EQ(p.worst_ray * 7919 % 10000, 9999u);
    EXPECT_EQ(p.decades, (decltype(p.decades){1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9, 90, 900, 9000}));
}

TEST(Comparison, NoRays) {
    Case c;
    const Comparison result = c.result();
    EXPECT_EQ(result.rays(), 0u);
    EXPECT_EQ(result.undecided_share(), 0);
    EXPECT_EQ(result.decisive.false_hit.bounds().high, 1);
}

TEST(RayError, FloatUlp) {
    EXPECT_EQ(float_ulp(1.0), std::ldexp(1.0, -23));
    EXPECT_EQ(float_ulp(1.9999999), std::ldexp(1.0, -23));
    EXPECT_EQ(float_ulp(-2.0), std::ldexp(1.0, -22));
    EXPECT_EQ(float_ulp(0.0), std::ldexp(1.0, -149));
    EXPECT_EQ(float_ulp(1e-42), std::ldexp(1.0, -149));
    EXPECT_TRUE(std::isnan(float_ulp(std::numeric_limits<double>::infinity())));
}

TEST(RayError, AnglesAreAccurateWhereTheyAreSmall) {
    EXPECT_NEAR(angle_between({1, 0, 0}, {1, 1e-9, 0}), 1e-9 * 180 / 3.14159265358979, 1e-16);
    EXPECT_NEAR(angle_between({1, 0, 0}, {-2, 0, 0}), 180, 1e-12);
    EXPECT_TRUE(std::isnan(angle_between({0, 0, 0}, {1, 0, 0})));
    EXPECT_TRUE(std::isnan(angle_between({std::nan(""), 0, 0}, {1, 0, 0})));
}

TEST(Comparison, RaysThatStartInsideTheTracedSurfaceAreAClassOfTheirOwn) {
    Case c;
    for (int i = 0; i < 4; ++i) c.add();
    c.hits[1] = {};  // a miss
    c.hits[2] = {};
    c.reference[2].starts_inside = true;  // inside both: the reference's class
    const std::vector<uint8_t> inside_own{0, 1, 1, 0};
    ComparisonInput input = c.input();
    input.inside_own = inside_own;
    const Comparison result = compare(input);
    EXPECT_EQ(result.all.rays, 2u);
    EXPECT_EQ(result.decisive.rays, 2u);
    EXPECT_EQ(result.all.false_miss.count, 0u);
    EXPECT_EQ(result.inside.rays, 1u);
    EXPECT_EQ(result.inside_own.rays, 1u);
    EXPECT_EQ(result.inside_own.false_miss.count, 1u);
    EXPECT_EQ(result.rays(), 4u);
}

}  // namespace
}  // namespace strandlab::testing
