// Percentiles of any number of positive values in little memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace strandlab {

/// Counts of values >= 0 in bins a 32nd of an octave wide, from 2^-60 to 2^60 (values beyond go to the outer
/// bins; 0 to the first). Percentiles are at most 2.2 % too large.
class LogHistogram {
  public:
    void add(double value) {
        ++counts_[bin_of(value)];
        ++count_;
        max_ = std::max(max_, value);
    }
    uint64_t count() const { return count_; }
    double max() const { return max_; }

    /// The upper edge of the bin of the q-quantile by nearest rank (0 where that bin is the first), and
    /// never more than the largest value; 0 without values.
    double quantile(double q) const {
        if (count_ == 0) return 0;
        const auto rank = static_cast<uint64_t>(std::max(1.0, std::ceil(q * static_cast<double>(count_))));
        uint64_t seen = 0;
        for (size_t i = 0; i < bins; ++i) {
            seen += counts_[i];
            if (seen >= rank) return i == 0 ? 0 : std::min(max_, edge(i + 1));
        }
        return max_;
    }

    /// How many values certainly exceed a limit: those in bins above the limit's own.
    uint64_t count_above(double limit) const {
        uint64_t above = 0;
        for (size_t i = bin_of(limit) + 1; i < bins; ++i) above += counts_[i];
        return above;
    }

    static constexpr int first_octave = -60, last_octave = 60;
    /// How many values lie in [2^exponent, 2^(exponent + 1)); the outer octaves also hold what lies beyond.
    uint64_t octave(int exponent) const {
        const auto first = counts_.begin() + std::ptrdiff_t(exponent - first_octave) * 32;
        return std::accumulate(first, first + 32, uint64_t(0));
    }

  private:
    static constexpr size_t bins = (last_octave - first_octave) * 32;

    static double edge(size_t bin) { return std::exp2(static_cast<double>(bin) / 32 + first_octave); }
    static size_t bin_of(double value) {
        if (!(value > 0)) return 0;
        const double place = std::floor((std::log2(value) - first_octave) * 32);
        return static_cast<size_t>(std::clamp(place, 0.0, double(bins - 1)));
    }

    std::array<uint64_t, bins> counts_{};
    uint64_t count_ = 0;
    double max_ = 0;
};

}  // namespace strandlab
