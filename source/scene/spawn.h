// Where rays start that leave a hit.
#pragma once

#include "scene/surface.h"

#include <glm/glm.hpp>

namespace strandlab {

/// How far along the outward normal a ray must start from the surface that it leaves, so that the primitive's
/// own intersector (with tmin = 0) does not report that surface again: max(radii * r, ulps * ulp(size)),
/// where r is the radius at the hit and size the largest coordinate of the curve's control points. The first
/// term covers the error of the intersector, the second the rounding of the start to float.
struct SpawnOffset {
    double radii = 0, ulps = 0;

    double distance(double radius, double size) const;
};

/// A hit as a renderer knows it. The point is to be built from the curve (surface_point) or from the vertices
/// of a triangle, not as origin + t direction, whose error grows with the distance that the ray has come
/// from.
struct SpawnPlace {
    glm::vec3 point{0}, normal{0};  // the normal: unit, outward (of a triangle: on the side of the ray)
    float radius = 0, size = 0;
    /// Of crossed strips: unit, across the strand away from its centre line, and how far the point is from
    /// it. The other strip stands there and holds the normal: moving along the normal does not leave it.
    glm::vec3 aside{0};
    float across = 0;
};

/// Where rays start at a distance from the surface: that far along the normal, and as far from the other
/// strip where there is one.
glm::vec3 spawn_origin(const SpawnPlace& place, float distance);

/// What rays that are the same for every primitive are moved by: no primitive asks for more.
inline constexpr SpawnOffset common_spawn_offset{0.01, 4};

/// The point of a swept piece at u of its curve that has this outward unit normal, in float as a renderer
/// computes it: C(u) + r n of swept spheres, C(u) + r e of swept discs, where e is the part of n across the
/// tangent. False where a disc's normal runs along the tangent (a flat cap).
bool surface_point(const SurfacePiece& piece, Surface::Sweep sweep, float u, const glm::vec3& normal,
                   glm::vec3& point);

/// Largest coordinate of the control points.
float coordinate_size(const SurfacePiece& piece);
float coordinate_size(const SurfaceTriangle& triangle);

}  // namespace strandlab
