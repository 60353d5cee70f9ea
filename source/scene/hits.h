// What a trace returns, for every primitive and every reference.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace strandlab {

inline constexpr uint32_t no_curve = 0xFFFFFFFFu;

/// One hit, or a miss (t = +infinity, curve = no_curve). Layout: 16 bytes, as the shaders write it.
struct Hit {
    float t = std::numeric_limits<float>::infinity();  // ray parameter
    float u = 0;                                       // parameter on the curve, 0 at its root side
    uint32_t curve = no_curve;                         // index into the scene's curves
    uint32_t instance = 0;                             // index into the scene's instances

    bool is_hit() const { return curve != no_curve; }
};
static_assert(sizeof(Hit) == 16);

/// The hits of a ray set, one per ray; normals (unit, outward, world space) only when asked for.
struct Hits {
    std::vector<Hit> hits;
    std::vector<glm::vec3> normals;
};

/// A hit of a double-precision reference, with what it knows about its own certainty.
struct ReferenceHit {
    double t = std::numeric_limits<double>::infinity();
    double u = 0;
    glm::dvec3 normal{0};  // unit, outward, world space
    double radius = 0;     // of the surface at the hit, world space
    uint32_t curve = no_curve;
    uint32_t instance = 0;
    bool on_cap = false;         // the hit lies on a strand-end cap
    bool starts_inside = false;  // the ray starts inside the surface: a class of its own

    bool is_hit() const { return curve != no_curve; }
};

}  // namespace strandlab
