// Random points and directions made of + - * / and sqrt alone, so that every machine draws the same.
#pragma once

#include "base/random.h"

#include <glm/glm.hpp>

#include <cmath>

namespace strandlab {

/// A uniform point of the open unit disc (by rejection: on average 1.27 tries).
inline glm::dvec2 sample_disc(Random& random) {
    for (;;) {
        const double x = random.signed_unit(), y = random.signed_unit();
        if (x * x + y * y < 1) return {x, y};
    }
}

/// A uniform unit direction (Marsaglia 1972).
inline glm::dvec3 sample_sphere(Random& random) {
    const glm::dvec2 p = sample_disc(random);
    const double s = glm::dot(p, p), root = std::sqrt(1 - s);
    return {2 * p.x * root, 2 * p.y * root, 1 - 2 * s};
}

/// A unit vector orthogonal to the unit vector n: across n and the coordinate axis farthest from it.
inline glm::dvec3 orthogonal_to(const glm::dvec3& n) {
    const glm::dvec3 size = glm::abs(n);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(n, axis));
}

/// A unit direction with density cos(angle to n) / pi about the unit normal n: a uniform point of the
/// disc lifted to the hemisphere (Malley's method).
inline glm::dvec3 sample_cosine(Random& random, const glm::dvec3& n) {
    const glm::dvec2 p = sample_disc(random);
    const glm::dvec3 across = orthogonal_to(n), along = glm::cross(n, across);
    return glm::normalize(across * p.x + along * p.y + n * std::sqrt(1 - glm::dot(p, p)));
}

}  // namespace strandlab
