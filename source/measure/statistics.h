// Summaries of repeated measurements, and how far a count can be trusted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace strandlab {

/// A closed interval.
struct Interval {
    double low = 0, high = 0;
};

/// What repeated measurements of one quantity say, in the unit of the samples.
struct Summary {
    size_t count = 0;        // finite samples; all that follows is 0 when there is none
    double median = 0;       // mean of the two middle samples when count is even
    double mad = 0;          // median of |sample - median|, not scaled to a normal deviation
    double p5 = 0, p95 = 0;  // nearest rank
    double min = 0, max = 0;
    Interval median_bounds;  // 95 % percentile bootstrap of the median (Efron 1979), 2000 resamples
};

/// Summarises the finite samples (others are left out). The bootstrap draws from seed, so that equal
/// samples give equal intervals on every machine.
Summary summarise(std::span<const double> samples, uint64_t seed = 1);

/// The index (from 0) of the q-quantile among count > 0 sorted values by nearest rank: the smallest value
/// that at least a share q of all values does not exceed. No interpolation: it is one of the values.
size_t nearest_rank(double q, size_t count);

/// Regularised incomplete beta function I_x(a, b) for a, b > 0 (continued fraction, modified Lentz).
double incomplete_beta(double a, double b, double x);

/// Bounds of a probability of which `count` of `trials` draws were seen: exact binomial bounds (Clopper
/// and Pearson 1934). Where nothing or everything was seen, only one side can be bounded and gets the
/// whole error probability: 0 of n gives [0, 1 - 0.05^(1/n)], about 3/n (the "rule of three").
/// No trials: [0, 1].
Interval binomial_bounds(uint64_t count, uint64_t trials, double confidence = 0.95);

}  // namespace strandlab
