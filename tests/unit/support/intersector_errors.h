// Counts and percentiles of what an intersector got wrong on decisive rays.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace strandlab::testing {

/// Errors of one intersector on one family. Rates are per decisive ray of their class.
struct IntersectorErrors {
    size_t hits = 0, misses = 0;  // decisive, by the reference
    size_t false_misses = 0, false_hits = 0, wrong_hits = 0;
    std::vector<double> distances;  // |dt| |direction| / r of the right hits
    std::vector<double> angles;     // between normals, radians

    /// A hit where the reference has one. Distances beyond half a radius, and beyond 8 ulp(t), are wrong
    /// hits.
    void add_hit(double t, double reference_t, double length, double radius, double angle) {
        const double error = std::abs(t - reference_t);
        const double ulp = std::abs(reference_t) * std::ldexp(1.0, -23);
        if (!(error <= std::max(0.5 * radius / length, 8 * ulp))) {
            ++wrong_hits;
            return;
        }
        distances.push_back(error * length / radius);
        angles.push_back(angle);
    }

    double false_miss_rate() const { return hits > 0 ? double(false_misses) / double(hits) : 0; }
    double false_hit_rate() const { return misses > 0 ? double(false_hits) / double(misses) : 0; }
    double wrong_hit_rate() const { return hits > 0 ? double(wrong_hits) / double(hits) : 0; }

    static double percentile(std::vector<double> values, double p) {
        if (values.empty()) return 0;
        const auto rank = static_cast<std::ptrdiff_t>(p * double(values.size() - 1));
        std::nth_element(values.begin(), values.begin() + rank, values.end());
        return values[static_cast<size_t>(rank)];
    }

    std::string row(const std::string& name) const {
        return fmt::format(
            "{:14} {:6} / {:6} | {:7.1e} {:7.1e} {:7.1e} | {:7.1e} {:7.1e} {:7.1e} | {:5.2f} {:6.2f}\n", name,
            hits, misses, false_miss_rate(), false_hit_rate(), wrong_hit_rate(), percentile(distances, 0.5),
            percentile(distances, 0.99), percentile(distances, 1), percentile(angles, 0.5) * 57.29578,
            percentile(angles, 0.99) * 57.29578);
    }
    static std::string header() {
        return "family           hits / misses | false miss, hit, wrong  | dt/r p50, p99, max      | normal "
               "p50, p99\n";
    }
};

}  // namespace strandlab::testing
