#include "scene/bounds.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

/// Extrema of a cubic in Bernstein form on [a, b]: the ends and the roots of the derivative, by the
/// formula for quadratics that does not cancel.
struct Range {
    double low, high;
};

double evaluate(const double (&c)[4], double u) {
    const double v = 1 - u;
    return v * v * (v * c[0] + 3 * u * c[1]) + u * u * (3 * v * c[2] + u * c[3]);
}

Range range_of(const double (&c)[4], double a, double b) {
    const double at_a = evaluate(c, a), at_b = evaluate(c, b);
    Range range{std::min(at_a, at_b), std::max(at_a, at_b)};
    const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
    // d0 (1-u)^2 + 2 d1 u (1-u) + d2 u^2 = A u^2 + 2 B u + C
    const double A = d0 - 2 * d1 + d2, B = d1 - d0, C = d0;
    const double discriminant = B * B - A * C;
    if (!(discriminant >= 0)) return range;
    const double q = -(B + std::copysign(std::sqrt(discriminant), B));
    for (const double u : {q / A, C / q}) {
        if (!(u > a && u < b)) continue;
        const double value = evaluate(c, u);
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    }
    return range;
}

/// Rounding of the evaluation above, and of what a shader decodes, stays below this many ulp.
constexpr float outward_ulps = 4;

float ulp(float magnitude) {
    return std::nextafter(magnitude, std::numeric_limits<float>::infinity()) - magnitude;
}

void round_outwards(Box& box, int axis, double low, double high, double magnitude) {
    const float margin = outward_ulps * ulp(static_cast<float>(magnitude));
    box.low[axis] = std::nextafter(static_cast<float>(low) - margin, -std::numeric_limits<float>::infinity());
    box.high[axis] =
        std::nextafter(static_cast<float>(high) + margin, std::numeric_limits<float>::infinity());
}

}  // namespace

Box bounds_of(const Curve& curve, double a, double b) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        double low[4], high[4], magnitude = 0;
        for (int i = 0; i < 4; ++i) {
            const double position = curve[i][axis], radius = curve[i].w;
            low[i] = position - radius;
            high[i] = position + radius;
            magnitude = std::max({magnitude, std::abs(low[i]), std::abs(high[i])});
        }
        round_outwards(box, axis, range_of(low, a, b).low, range_of(high, a, b).high, magnitude);
    }
    return box;
}

Box bounds_of(const glm::vec4& start, const glm::vec4& end) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const double r0 = start.w, r1 = end.w;
        const double low = std::min(start[axis] - r0, end[axis] - r1);
        const double high = std::max(start[axis] + r0, end[axis] + r1);
        round_outwards(box, axis, low, high, std::max(std::abs(low), std::abs(high)));
    }
    return box;
}

Box padded(const Box& box, float extent) {
    const glm::vec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
    const float margin = 4 * ulp(std::max({reach.x, reach.y, reach.z}) + extent);
    return {box.low - margin, box.high + margin};
}

}  // namespace strandlab
