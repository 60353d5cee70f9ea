// Classes of agreement between an intersector and a reference, over decisive rays.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace strandlab::testing {

/// Counts over decisive rays, and the errors of the hits that agree.
struct HitStatistics {
    size_t hits = 0, misses = 0;  // of the reference
    size_t false_misses = 0, false_hits = 0, wrong_hits = 0;
    std::vector<double> depth_errors;   // |dt| |d| / r
    std::vector<double> normal_errors;  // radians

    double false_miss_rate() const { return double(false_misses) / double(std::max<size_t>(hits, 1)); }
    double false_hit_rate() const { return double(false_hits) / double(std::max<size_t>(misses, 1)); }
    double wrong_hit_rate() const { return double(wrong_hits) / double(std::max<size_t>(hits, 1)); }
};

/// Quantile q of the values (reorders them); 0 of none.
inline double quantile(std::vector<double>& values, double q) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace strandlab::testing
