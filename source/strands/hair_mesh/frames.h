// Directions u and v at the vertices of a hair mesh, along which styling displaces strands.
#pragma once

#include "strands/hair_mesh/columns.h"

#include <array>

namespace strandlab {

/// Directions at one place.
struct SurfaceDirections {
    glm::dvec3 u{0}, v{0};
};

/// How the surface runs with u and with v on a triangle: the 3 x 2 matrix [p1 - p0, p2 - p0] T^-1, T having
/// the uv edges as columns (Bhokare et al. 2024, "Real-Time Hair Rendering with Hair Meshes", Eq. 2-3).
SurfaceDirections surface_directions(const std::array<glm::dvec3, 3>& points,
                                     const std::array<glm::dvec2, 3>& uv);

/// Sets columns.u and columns.v by the mesh's rule; controls must be set. Rule layer: on every layer the mean
/// of the corner triangles at the vertex, weighted by their uv areas, normalised (Eq. 1). Rule root: those of
/// the root layer, made orthonormal, turned with the normal onto the column's root tangent (minimal rotation)
/// and carried along the column without twist (double reflection, Wang et al. 2008). All faces at a vertex
/// share its directions: blends have no seam.
void set_frames(const HairMesh& mesh, HairMeshColumns& columns);

}  // namespace strandlab
