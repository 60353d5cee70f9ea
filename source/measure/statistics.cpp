#include "measure/statistics.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace strandlab {
namespace {

constexpr size_t resamples = 2000;

/// Median of values whose order may change.
double median_of(std::span<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    const double below = *std::max_element(values.begin(), middle);
    return below + (*middle - below) / 2;
}

Interval bootstrap_median(std::span<const double> samples, uint64_t seed) {
    const auto count = static_cast<uint32_t>(samples.size());
    std::vector<double> medians(resamples);
    parallel_for(resamples, [&](size_t i) {
        thread_local std::vector<double> drawn;
        drawn.resize(count);
        Random random(seed, 0, i);
        for (double& value : drawn) value = samples[random.below(count)];
        medians[i] = median_of(drawn);
    });
    std::sort(medians.begin(), medians.end());
    return {medians[nearest_rank(0.025, resamples)], medians[nearest_rank(0.975, resamples)]};
}

/// ln of x^a (1-x)^b / (a B(a, b)).
double log_front(double a, double b, double x) {
    // lgamma of glibc writes a global sign, but never a different one for positive arguments.
    return std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x) -
           std::log(a);
}

/// The continued fraction of I_x(a, b) / front; converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double tiny = 1e-300;
    const auto guarded = [](double value) { return std::abs(value) < tiny ? tiny : value; };
    double c = 1;
    double d = 1 / guarded(1 - (a + b) * x / (a + 1));
    double result = d;
    for (int m = 1; m < 1'000'000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / guarded(1 + even * d);
        c = guarded(1 + even / c);
        result *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / guarded(1 + odd * d);
        c = guarded(1 + odd / c);
        result *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return result;
}

/// The x in (0, 1) with I_x(a, b) = p.
double inverse_incomplete_beta(double a, double b, double p) {
    double low = 0, high = 1;
    // The answer can be as small as 1/trials: bisect until the relative width is at rounding.
    for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
        const double middle = low + (high - low) / 2;
        (incomplete_beta(a, b, middle) < p ? low : high) = middle;
    }
    return low + (high - low) / 2;
}

}  // namespace

size_t nearest_rank(double q, size_t count) {
    assert(count > 0);
    // Shares such as 0.95 are not exact in binary: 0.95 * 20 must be rank 19, not 20.
    const double rank = std::ceil(q * static_cast<double>(count) * (1 - 1e-15) - 1e-9);
    const auto index = rank < 1 ? size_t(0) : static_cast<size_t>(rank) - 1;
    return std::min(index, count - 1);
}

Summary summarise(std::span<const double> samples, uint64_t seed) {
    std::vector<double> sorted;
    std::copy_if(samples.begin(), samples.end(), std::back_inserter(sorted),
                 [](double x) { return std::isfinite(x); });
    Summary summary;
    summary.count = sorted.size();
    if (sorted.empty()) return summary;
    assert(sorted.size() <= std::numeric_limits<uint32_t>::max());
    std::sort(sorted.begin(), sorted.end());
    summary.min = sorted.front();
    summary.max = sorted.back();
    summary.p5 = sorted[nearest_rank(0.05, sorted.size())];
    summary.p95 = sorted[nearest_rank(0.95, sorted.size())];
    summary.median_bounds = bootstrap_median(sorted, seed);
    summary.median = median_of(sorted);
    for (double& value : sorted) value = std::abs(value - summary.median);
    summary.mad = median_of(sorted);
    return summary;
}

double incomplete_beta(double a, double b, double x) {
    assert(a > 0 && b > 0);
    if (!(x > 0)) return 0;
    if (!(x < 1)) return 1;
    if (x < (a + 1) / (a + b + 2)) return std::exp(log_front(a, b, x)) * beta_fraction(a, b, x);
    return 1 - std::exp(log_front(b, a, 1 - x)) * beta_fraction(b, a, 1 - x);
}

Interval binomial_bounds(uint64_t count, uint64_t trials, double confidence) {
    assert(count <= trials && confidence > 0 && confidence < 1);
    if (trials == 0) return {0, 1};
    const double alpha = 1 - confidence;
    const auto n = static_cast<double>(trials), k = static_cast<double>(count);
    if (count == 0) return {0, -std::expm1(std::log(alpha) / n)};
    if (count == trials) return {std::exp(std::log(alpha) / n), 1};
    return {inverse_incomplete_beta(k, n - k + 1, alpha / 2),
            inverse_incomplete_beta(k + 1, n - k, 1 - alpha / 2)};
}

}  // namespace strandlab
