#include "base/sine.h"

#include <cmath>
#include <cstdint>

namespace strandlab {
namespace {

/// 1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (...)): the Taylor series of both functions in nested form, nine
/// terms: the next one is below 1e-17 for z <= (pi/4)^2.
double nested_series(double z, int n) {
    double sum = 1;
    for (int k = n + 16; k >= n; k -= 2) sum = 1 - z / (double(k) * (k + 1)) * sum;
    return sum;
}

}  // namespace

SinCos sin_cos(double x) {
    constexpr double two_over_pi = 0.63661977236758134308;
    // pi/2 in two parts; the first has few enough bits for exact products with the quadrant.
    constexpr double high = 0x1.921fb544p+0, low = 0x1.0b4611a626331p-34;
    const double quadrant = std::floor(x * two_over_pi + 0.5);
    const double r = (x - quadrant * high) - quadrant * low;
    const double s = r * nested_series(r * r, 2), c = nested_series(r * r, 1);
    switch (static_cast<int64_t>(quadrant) & 3) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

}  // namespace strandlab
