#include "scene/spawn.h"

#include "base/float_ulp.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

template <class Point>
float largest_of(const Point& point) {
    return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
}

/// Point and derivative with respect to v by de Casteljau's scheme, in float.
glm::vec4 point_and_derivative(const SurfacePiece& piece, float v, glm::vec4& derivative) {
    const auto& c = piece.control;
    if (piece.straight) {
        derivative = c[3] - c[0];
        return glm::mix(c[0], c[3], v);
    }
    const glm::vec4 a0 = glm::mix(c[0], c[1], v), a1 = glm::mix(c[1], c[2], v), a2 = glm::mix(c[2], c[3], v);
    const glm::vec4 b0 = glm::mix(a0, a1, v), b1 = glm::mix(a1, a2, v);
    derivative = 3.0f * (b1 - b0);
    return glm::mix(b0, b1, v);
}

}  // namespace

double SpawnOffset::distance(double radius, double size) const {
    return std::max(radii * radius, ulps * float_ulp(size));
}

glm::vec3 spawn_origin(const SpawnPlace& place, float distance) {
    const float missing = std::max(0.0f, distance - place.across);
    return place.point + place.normal * distance + place.aside * missing;
}

bool surface_point(const SurfacePiece& piece, Surface::Sweep sweep, float u, const glm::vec3& normal,
                   glm::vec3& point) {
    glm::vec4 derivative;
    const float v = std::clamp((u - piece.u0) / (piece.u1 - piece.u0), 0.0f, 1.0f);
    const glm::vec4 centre = point_and_derivative(piece, v, derivative);
    glm::vec3 arm = normal;
    const glm::vec3 tangent(derivative);
    const float speed = glm::length(tangent);
    if (sweep == Surface::Sweep::disc && speed > 0) {
        arm -= tangent * (glm::dot(tangent, normal) / (speed * speed));
        const float size = glm::length(arm);
        if (!(size > 1e-3f)) return false;
        arm /= size;
    }
    point = glm::vec3(centre) + centre.w * arm;
    return true;
}

float coordinate_size(const SurfacePiece& piece) {
    const float ends = std::max(largest_of(piece.control[0]), largest_of(piece.control[3]));
    return piece.straight ? ends
                          : std::max({ends, largest_of(piece.control[1]), largest_of(piece.control[2])});
}

float coordinate_size(const SurfaceTriangle& triangle) {
    return std::max(
        {largest_of(triangle.vertex[0]), largest_of(triangle.vertex[1]), largest_of(triangle.vertex[2])});
}

}  // namespace strandlab
