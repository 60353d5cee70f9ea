#include "measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace strandlab {
namespace {

TEST(Statistics, SummarisesAnOddCount) {
    const std::vector<double> samples{5, 1, 4, 2, 3};
    const Summary s = summarise(samples);
    EXPECT_EQ(s.count, 5u);
    EXPECT_EQ(s.median, 3);
    EXPECT_EQ(s.mad, 1);
    EXPECT_EQ(s.min, 1);
    EXPECT_EQ(s.max, 5);
    EXPECT_EQ(s.p5, 1);
    EXPECT_EQ(s.p95, 5);
}

TEST(Statistics, MedianOfAnEvenCountIsTheMiddle) {
    const std::vector<double> samples{4, 1, 3, 10};
    EXPECT_EQ(summarise(samples).median, 3.5);
    EXPECT_EQ(summarise(samples).mad, 1.5);  // deviations 0.5, 2.5, 0.5, 6.5
}

TEST(Statistics, LeavesOutWhatIsNotFinite) {
    const std::vector<double> samples{std::nan(""), 2, std::numeric_limits<double>::infinity()};
    const Summary s = summarise(samples);
    EXPECT_EQ(s.count, 1u);
    EXPECT_EQ(s.median, 2);
    EXPECT_EQ(s.mad, 0);
    EXPECT_EQ(s.median_bounds.low, 2);
    EXPECT_EQ(s.median_bounds.high, 2);
    EXPECT_EQ(summarise({}).count, 0u);
}

TEST(Statistics, BootstrapHoldsTheMedianAndRepeats) {
    std::vector<double> samples;
    for (int i = 0; i < 101; ++i) samples.push_back(i);
    const Summary s = summarise(samples, 7), again = summarise(samples, 7);
    EXPECT_LT(s.median_bounds.low, 50);
    EXPECT_GT(s.median_bounds.high, 50);
    // Order statistics: the 95 % interval of the median of n = 101 is about ranks 50 -+ 0.98 sqrt(101).
    EXPECT_NEAR(s.median_bounds.low, 40, 4);
    EXPECT_NEAR(s.median_bounds.high, 60, 4);
    EXPECT_EQ(s.median_bounds.low, again.median_bounds.low);
    EXPECT_EQ(s.median_bounds.high, again.median_bounds.high);
}

TEST(Statistics, NearestRank) {
    EXPECT_EQ(nearest_rank(0.5, 1), 0u);
    EXPECT_EQ(nearest_rank(0.5, 2), 0u);
    EXPECT_EQ(nearest_rank(0.5, 3), 1u);
    EXPECT_EQ(nearest_rank(0.95, 20), 18u);
    EXPECT_EQ(nearest_rank(0.95, 21), 19u);
    EXPECT_EQ(nearest_rank(0.999, 1000), 998u);
    EXPECT_EQ(nearest_rank(0.999, 100'000'000), 99'899'999u);
    EXPECT_EQ(nearest_rank(0.0, 10), 0u);
    EXPECT_EQ(nearest_rank(1.0, 1'000'000'007), 1'000'000'006u);
}

TEST(Statistics, IncompleteBeta) {
    EXPECT_NEAR(incomplete_beta(1, 1, 0.3), 0.3, 1e-14);
    EXPECT_NEAR(incomplete_beta(2, 3, 0.4), 0.5248, 1e-13);  // 1 - P(Bin(4, 0.4) <= 1)
    EXPECT_NEAR(incomplete_beta(0.5, 0.5, 0.5), 0.5, 1e-13);
    EXPECT_EQ(incomplete_beta(2, 2, 0), 0);
    EXPECT_EQ(incomplete_beta(2, 2, 1), 1);
}

/// P(Bin(n, p) <= k) by summing logarithms.
double binomial_at_most(int k, int n, double p) {
    double sum = 0;
    for (int i = 0; i <= k; ++i)
        sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                        i * std::log(p) + (n - i) * std::log1p(-p));
    return sum;
}

TEST(Statistics, BinomialBoundsLeaveTheTailsTheyPromise) {
    for (const auto& [k, n] : std::vector<std::pair<int, int>>{{1, 10}, {5, 10}, {3, 1000}, {999, 1000}}) {
        const Interval bounds = binomial_bounds(static_cast<uint64_t>(k), static_cast<uint64_t>(n));
        EXPECT_NEAR(binomial_at_most(k, n, bounds.high), 0.025, 1e-9) << k << " of " << n;
        EXPECT_NEAR(1 - binomial_at_most(k - 1, n, bounds.low), 0.025, 1e-9) << k << " of " << n;
    }
    // Tabulated: 5 of 10.
    EXPECT_NEAR(binomial_bounds(5, 10).low, 0.187086, 1e-6);
    EXPECT_NEAR(binomial_bounds(5, 10).high, 0.812914, 1e-6);
}

TEST(Statistics, NothingSeenProvesLittle) {
    EXPECT_EQ(binomial_bounds(0, 100).low, 0);
    EXPECT_NEAR(binomial_bounds(0, 100).high, 0.029513, 1e-6);  // about 3 / n
    EXPECT_NEAR(binomial_bounds(0, 1'000'000).high, 2.995732e-6, 1e-10);
    EXPECT_NEAR(binomial_bounds(100, 100).low, 1 - 0.029513, 1e-6);
    EXPECT_EQ(binomial_bounds(100, 100).high, 1);
    EXPECT_EQ(binomial_bounds(0, 0).low, 0);
    EXPECT_EQ(binomial_bounds(0, 0).high, 1);
}

TEST(Statistics, BinomialBoundsOfManyTrials) {
    const Interval bounds = binomial_bounds(50'000'000, 100'000'000);
    EXPECT_NEAR(bounds.low, 0.5 - 1.959964 * 0.5e-4, 1e-8);
    EXPECT_NEAR(bounds.high, 0.5 + 1.959964 * 0.5e-4, 1e-8);
}

}  // namespace
}  // namespace strandlab
