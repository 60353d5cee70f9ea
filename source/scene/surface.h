// The exact surface that a primitive's records decode to: what an oracle intersects.
#pragma once

#include "scene/caps.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace strandlab {

/// A cubic Bezier piece (x, y, z, radius) of a swept surface, for the parameters [u0, u1] of its curve.
/// A straight piece uses control[0] and control[3] only; centre and radius are linear between them.
struct SurfacePiece {
    std::array<glm::vec4, 4> control;
    uint32_t curve = 0;
    float u0 = 0, u1 = 1;
    bool straight = false;
    bool begins_strand = false, ends_strand = false;
};

/// A triangle; centre[i] is the point of the centre line that vertex[i] was offset from, so that the
/// oracle can scale the width. u[i] is the curve parameter at the vertex.
struct SurfaceTriangle {
    std::array<glm::vec3, 3> vertex, centre;
    std::array<float, 3> u{0, 0, 0};
    uint32_t curve = 0;
};

/// Union of swept pieces (balls, or discs normal to the tangent) and triangles, with strand ends
/// closed as caps says. Interior joints are closed: of spheres by themselves, of discs by continuity.
/// Swept surfaces are front-face only (entering hits count); triangles are two-sided.
struct Surface {
    enum class Sweep { sphere, disc };
    Sweep sweep = Sweep::sphere;
    Caps caps = Caps::round;
    std::vector<SurfacePiece> pieces;
    std::vector<SurfaceTriangle> triangles;
};

}  // namespace strandlab
