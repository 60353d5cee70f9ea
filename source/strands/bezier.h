// Cubic Bezier curves with a radius as fourth component: evaluation, derivatives, restriction.
#pragma once

#include "strands/curves.h"

#include <glm/glm.hpp>

#include <array>

namespace strandlab {

/// Control points in double, (x, y, z, radius).
using CurveD = std::array<glm::dvec4, 4>;

inline CurveD to_double(const Curve& c) {
    return {glm::dvec4(c[0]), glm::dvec4(c[1]), glm::dvec4(c[2]), glm::dvec4(c[3])};
}

inline Curve to_float(const CurveD& c) {
    return {glm::vec4(c[0]), glm::vec4(c[1]), glm::vec4(c[2]), glm::vec4(c[3])};
}

/// C(u).
inline glm::dvec4 point_at(const CurveD& c, double u) {
    const double v = 1 - u;
    return v * v * (v * c[0] + 3 * u * c[1]) + u * u * (3 * v * c[2] + u * c[3]);
}

/// C'(u).
inline glm::dvec4 derivative_at(const CurveD& c, double u) {
    const double v = 1 - u;
    return 3.0 * (v * v * (c[1] - c[0]) + 2 * u * v * (c[2] - c[1]) + u * u * (c[3] - c[2]));
}

/// C''(u).
inline glm::dvec4 second_derivative_at(const CurveD& c, double u) {
    return 6.0 * ((1 - u) * (c[2] - 2.0 * c[1] + c[0]) + u * (c[3] - 2.0 * c[2] + c[1]));
}

/// The control points of the part [a, b], reparametrised to [0, 1] (blossoming).
CurveD restricted(const CurveD& c, double a, double b);

/// Upper bound of the angle (radians) that the tangent turns on [a, b]: the sum of the angles between
/// successive edges of the control polygon.
double turning_bound(const CurveD& c);

/// Unit tangent at u; where C' vanishes, the limit from C'' or the chord. Zero for a curve that is one
/// point.
glm::dvec3 tangent_at(const CurveD& c, double u);

}  // namespace strandlab
