// Whether one set of times is longer than another by more than a factor, and how sure that is.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace strandlab {

/// The upper tail of Student's t distribution: P(T > t) with so many degrees of freedom (> 0, not whole).
double student_tail(double t, double degrees);

/// How many times as long as `before` the samples of `now` are: Welch's t interval (1947) of the difference
/// of mean logarithms, so that single outliers widen it rather than move it.
class TimeRatioTest {
  public:
    /// Samples that are not positive and finite are left out.
    TimeRatioTest(std::span<const double> now, std::span<const double> before);

    /// At least two samples on both sides.
    bool is_known() const { return known_; }
    /// Ratio of the geometric means.
    double ratio() const;
    /// Probability of such samples if the true ratio were at most `factor`.
    double p_above(double factor) const;
    /// And if it were at least that.
    double p_below(double factor) const;
    /// The ratio is above (below) this, but for an error probability alpha.
    double lower_bound(double alpha) const;
    double upper_bound(double alpha) const;

  private:
    double quantile(double alpha) const;

    bool known_ = false;
    double difference_ = 0, error_ = 0, degrees_ = 1;
};

/// Which of several hypotheses to reject so that all rejections together are wrong with probability alpha at
/// most (Holm 1979): 0 for those that stay, otherwise the level that each was held to.
std::vector<double> holm_levels(std::span<const double> p_values, double alpha = 0.05);

}  // namespace strandlab
