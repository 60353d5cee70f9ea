#include "measure/time_ratio.h"

#include "measure/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace strandlab {
namespace {

/// Mean and squared standard error of the logarithms.
struct LogMean {
    size_t count = 0;
    double mean = 0, squared_error = 0;

    explicit LogMean(std::span<const double> samples) {
        std::vector<double> logs;
        for (const double sample : samples)
            if (sample > 0 && std::isfinite(sample)) logs.push_back(std::log(sample));
        count = logs.size();
        if (count < 2) return;
        const auto n = static_cast<double>(count);
        mean = std::accumulate(logs.begin(), logs.end(), 0.0) / n;
        double squares = 0;
        for (const double log : logs) squares += (log - mean) * (log - mean);
        squared_error = squares / ((n - 1) * n);
    }
};

}  // namespace

double student_tail(double t, double degrees) {
    assert(degrees > 0);
    const double half = 0.5 * incomplete_beta(degrees / 2, 0.5, degrees / (degrees + t * t));
    return t > 0 ? half : 1 - half;
}

TimeRatioTest::TimeRatioTest(std::span<const double> now, std::span<const double> before) {
    const LogMean a(now), b(before);
    known_ = a.count >= 2 && b.count >= 2;
    if (!known_) return;
    difference_ = a.mean - b.mean;
    // Clocks have ticks: samples that are all equal are known to a millionth, not exactly.
    const double squared = std::max(a.squared_error + b.squared_error, 1e-12);
    error_ = std::sqrt(squared);
    const double parts = a.squared_error * a.squared_error / static_cast<double>(a.count - 1) +
                         b.squared_error * b.squared_error / static_cast<double>(b.count - 1);
    const auto most = static_cast<double>(a.count + b.count - 2);
    degrees_ = parts > 0 ? std::clamp(squared * squared / parts, 1.0, most) : most;
}

double TimeRatioTest::ratio() const { return std::exp(difference_); }

double TimeRatioTest::p_above(double factor) const {
    return student_tail((difference_ - std::log(factor)) / error_, degrees_);
}

double TimeRatioTest::p_below(double factor) const {
    return student_tail((std::log(factor) - difference_) / error_, degrees_);
}

double TimeRatioTest::quantile(double alpha) const {
    double low = 0, high = 1;
    while (high < 1e12 && student_tail(high, degrees_) > alpha) high *= 2;
    for (int i = 0; i < 100; ++i) {
        const double middle = low + (high - low) / 2;
        (student_tail(middle, degrees_) > alpha ? low : high) = middle;
    }
    return high;
}

double TimeRatioTest::lower_bound(double alpha) const {
    return std::exp(difference_ - quantile(alpha) * error_);
}

double TimeRatioTest::upper_bound(double alpha) const {
    return std::exp(difference_ + quantile(alpha) * error_);
}

std::vector<double> holm_levels(std::span<const double> p_values, double alpha) {
    std::vector<size_t> order(p_values.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return p_values[a] < p_values[b]; });
    std::vector<double> levels(p_values.size(), 0);
    for (size_t i = 0; i < order.size(); ++i) {
        const double level = alpha / static_cast<double>(order.size() - i);
        if (!(p_values[order[i]] <= level)) break;
        levels[order[i]] = level;
    }
    return levels;
}

}  // namespace strandlab
