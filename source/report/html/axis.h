// Axes of charts: where a value lies, and which values are written beside them.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// A value with its name beside an axis.
struct Tick {
    double value = 0;
    std::string label;
};

/// A number as axes show it: "0.001", "20", "5000", "1,000,000" never; beyond four digits "10⁶", "2×10⁻⁵".
std::string tick_label(double value);

/// A logarithmic axis from pixel `from` (its low end) to pixel `to`.
class LogAxis {
  public:
    /// Covers the values from 1e-300 to 1e300 among those given, from a 1, 2 or 5 times a power of ten to
    /// another, and at least a factor of 10; 1 to 10 where there are none.
    LogAxis(std::span<const double> values, double from, double to);

    /// From low to high, both positive, low < high, with a tick at every power of two.
    static LogAxis doubling(double low, double high, double from, double to);

    double low() const { return low_; }
    double high() const { return high_; }
    /// The pixel of a positive value.
    double at(double value) const;
    /// At most `most` (at least 3): 1, 2 and 5 of each decade, else powers of ten, else every n-th of them;
    /// of a doubling axis powers of two, else every n-th of them.
    std::vector<Tick> ticks(size_t most) const;

  private:
    std::vector<Tick> doubling_ticks(size_t most) const;

    double low_, high_, from_, to_;
    bool doubling_ = false;
};

/// A linear axis from 0 at pixel `from` to at least `highest` at pixel `to`.
class LinearAxis {
  public:
    LinearAxis(double highest, double from, double to);

    double high() const { return high_; }
    double at(double value) const { return from_ + (to_ - from_) * value / high_; }
    /// 0 and the multiples of 1, 2 or 5 times a power of ten, at most six.
    std::vector<Tick> ticks() const;

  private:
    double high_, step_, from_, to_;
};

}  // namespace strandlab
