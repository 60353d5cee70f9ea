#include "strands/bezier.h"

#include <cmath>

namespace strandlab {
namespace {

/// The blossom (polar form) of a cubic: symmetric in s, t, v and C(u) at s = t = v = u.
glm::dvec4 blossom(const CurveD& c, double s, double t, double v) {
    const auto lerp = [](const glm::dvec4& a, const glm::dvec4& b, double w) { return (1 - w) * a + w * b; };
    const glm::dvec4 a0 = lerp(c[0], c[1], s), a1 = lerp(c[1], c[2], s), a2 = lerp(c[2], c[3], s);
    return lerp(lerp(a0, a1, t), lerp(a1, a2, t), v);
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

CurveD restricted(const CurveD& c, double a, double b) {
    return {blossom(c, a, a, a), blossom(c, a, a, b), blossom(c, a, b, b), blossom(c, b, b, b)};
}

double turning_bound(const CurveD& c) {
    glm::dvec3 previous(0);
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 edge(c[i + 1] - c[i]);
        if (edge == glm::dvec3(0)) continue;
        if (previous != glm::dvec3(0)) sum += angle_between(previous, edge);
        previous = edge;
    }
    return sum;
}

glm::dvec3 tangent_at(const CurveD& c, double u) {
    const glm::dvec3 chord(c[3] - c[0]);
    const double scale = glm::length(glm::dvec3(c[1] - c[0])) + glm::length(glm::dvec3(c[2] - c[1])) +
                         glm::length(glm::dvec3(c[3] - c[2]));
    glm::dvec3 tangent(derivative_at(c, u));
    if (!(glm::length(tangent) > 1e-7 * scale)) {
        // C' = 0 at an end: C'' points along the tangent there (away from u = 1, hence the sign).
        tangent = glm::dvec3(second_derivative_at(c, u)) * (u > 0.5 ? -1.0 : 1.0);
        if (!(glm::length(tangent) > 1e-7 * scale)) tangent = chord;
    }
    const double size = glm::length(tangent);
    return size > 0 ? tangent / size : glm::dvec3(0);
}

}  // namespace strandlab
