#include "measure/pareto.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace strandlab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double nan = std::nan("");

/// By the definition, pair by pair.
bool is_dominated(std::span<const TradeOff> cases, size_t i) {
    for (const TradeOff& other : cases) {
        if (!std::isfinite(other.cost) || !std::isfinite(other.error)) continue;
        if (other.cost <= cases[i].cost && other.error <= cases[i].error &&
            (other.cost < cases[i].cost || other.error < cases[i].error))
            return true;
    }
    return false;
}

TEST(Pareto, FrontIsWhatNoOtherCaseDominates) {
    const std::vector<TradeOff> cases{{1, 9}, {2, 4}, {3, 5}, {4, 1}, {4, 2}, {2, 4}, {9, 1}};
    EXPECT_EQ(pareto_front(cases), (std::vector<bool>{true, true, false, true, false, true, false}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(Pareto, AgreesWithTheDefinitionOnRandomCases) {
    Random random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<TradeOff> cases(static_cast<size_t>(1 + round % 40));
        for (TradeOff& one : cases) {
            one = {std::floor(random.uniform() * 8), std::floor(random.uniform() * 8)};
            if (random.uniform() < 0.1) one.error = random.uniform() < 0.5 ? infinity : nan;
        }
        const std::vector<bool> front = pareto_front(cases);
        for (size_t i = 0; i < cases.size(); ++i)
            EXPECT_EQ(front[i], std::isfinite(cases[i].error) && !is_dominated(cases, i)) << round;
    }
}

TEST(Pareto, CasesThatAreNotFiniteAreNeverOnIt) {
    const std::vector<TradeOff> cases{{nan, 0}, {0, nan}, {0, infinity}, {-infinity, 0}, {1, 1}};
    EXPECT_EQ(pareto_front(cases), (std::vector<bool>{false, false, false, false, true}));
}

TEST(Pareto, CheapestWithinALimit) {
    const std::vector<TradeOff> cases{{1, 0.2}, {nan, 0}, {3, 0.1}, {3, 0.05}, {2, nan}, {3, 0.05}};
    EXPECT_EQ(cheapest_within(cases, 0.1), 3u);
    EXPECT_EQ(cheapest_within(cases, 1), 0u);
    EXPECT_FALSE(cheapest_within(cases, 0.01));
    EXPECT_FALSE(cheapest_within(cases, nan));
}

TEST(Pareto, WrongRaysAreBeyondAnyDistance) {
    Comparison comparison;
    EXPECT_TRUE(std::isnan(ranking_error(comparison)));  // nothing was compared
    Tally& tally = comparison.all;
    tally.rays = 1000;
    tally.matches = 990;
    tally.measures[static_cast<size_t>(Measure::distance)] = {990, 0.01, 0.02, 0.03, 0.04, 0.05, 0};
    tally.false_miss.count = 4;
    tally.wrong_strand.count = 6;
    EXPECT_DOUBLE_EQ(wrong_share(tally), 0.01);
    EXPECT_EQ(ranking_error(comparison), 0.03);
    tally.agreed_misses = 500;  // background makes nobody better
    EXPECT_DOUBLE_EQ(wrong_share(tally), 0.02);
    EXPECT_EQ(ranking_error(comparison), infinity);
    tally.agreed_misses = 0;
    tally.nan.count = 1;
    EXPECT_EQ(ranking_error(comparison), infinity);
    comparison.hit_or_miss_only = true;
    EXPECT_EQ(ranking_error(comparison), infinity);
    tally.nan.count = 0;
    EXPECT_EQ(ranking_error(comparison), 0);
}

}  // namespace
}  // namespace strandlab
