// The spacing of floats.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {

/// Spacing of floats at |value| (of the smallest normal ones at 0), as a double; NaN for what is not finite.
inline double float_ulp(double value) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
    const int exponent = value == 0 ? -126 : std::max(std::ilogb(value), -126);
    return std::ldexp(1.0, exponent - 23);
}

}  // namespace strandlab
