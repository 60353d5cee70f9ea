// A strand's centre line as a rod that grows from an ellipsoid, bends under its weight, wanders a little
// and stays off the ellipsoid.
#pragma once

#include "base/random.h"

#include <glm/glm.hpp>

#include <vector>

namespace strandlab {

/// How rods grow.
struct RodStyle {
    glm::dvec3 semi_axes{0.078, 0.105, 0.095};  // of the ellipsoid, m; its centre is the origin
    double length = 0.25;                       // m
    double length_variation = 0.1;              // largest relative deviation
    double lift = 0.5;                          // 1: leaves along the normal, 0: along the combing direction
    double gravity = 20;                        // turning towards -y, 1/m
    double wander = 8;                          // amplitude of slow random turning, 1/m
    double layer = 0.14;                        // rods keep up to this far off, relative to the ellipsoid
};

/// Position, direction and a normal that is carried along without twist.
struct RodStep {
    glm::dvec3 position, direction, normal;
};

/// Grows a rod of steps + 1 entries into path from the root in direction u of the unit sphere; comb is
/// the direction that it is combed to (any vector not 0). Returns its length in metres. Draws from
/// random always in the same order.
double grow_rod(const RodStyle& style, Random& random, const glm::dvec3& u, const glm::dvec3& comb,
                size_t steps, std::vector<RodStep>& path);

}  // namespace strandlab
