// How many iterations searches take, exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace strandlab {

/// Counts of whole numbers: each up to 1022 has its own bin, larger ones share the last.
class IterationHistogram {
  public:
    static constexpr size_t bins = 1024;

    void add(uint32_t iterations) {
        ++counts_[std::min<size_t>(iterations, bins - 1)];
        ++count_;
        sum_ += iterations;
        max_ = std::max(max_, iterations);
    }
    uint64_t count() const { return count_; }
    uint32_t max() const { return max_; }
    double mean() const { return count_ == 0 ? 0 : double(sum_) / double(count_); }
    /// The q-quantile by nearest rank: exact below the last bin, at most max() there; 0 without values.
    uint32_t quantile(double q) const {
        const auto rank = static_cast<uint64_t>(std::max(1.0, std::ceil(q * double(count_))));
        uint64_t seen = 0;
        for (size_t i = 0; i + 1 < bins; ++i) {
            seen += counts_[i];
            if (count_ > 0 && seen >= rank) return static_cast<uint32_t>(i);
        }
        return max_;
    }
    /// The bins up to the largest value.
    std::span<const uint64_t> counts() const {
        return std::span(counts_).first(count_ == 0 ? 0 : std::min<size_t>(max_, bins - 1) + 1);
    }

  private:
    std::array<uint64_t, bins> counts_{};
    uint64_t count_ = 0, sum_ = 0;
    uint32_t max_ = 0;
};

}  // namespace strandlab
