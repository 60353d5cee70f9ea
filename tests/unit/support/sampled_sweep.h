// Brute force against swept spheres: dense samples of the curve, refined by bisection and golden section.
// Slow and plain, to judge intersectors by; shares nothing with them.
#pragma once

#include "scene/rays.h"
#include "strands/curves.h"

#include <limits>

namespace strandlab::testing {

/// The first entry of a ray into the union of the balls of a curve.
struct SweepHit {
    double t = std::numeric_limits<double>::infinity();
    double u = 0;
    double radius = 0;
    glm::dvec3 normal{0};
    bool starts_inside = false;

    bool is_hit() const { return t < std::numeric_limits<double>::infinity(); }
};

/// The first entry with t >= ray.tmin. A connected part of {u: the ray line meets the ball at u} that the ray
/// enters before tmin does not count: the ray starts inside. With open ends, a part whose nearest
/// point lies at u = 0 or u = 1 does not count either. All radii are multiplied by radius_scale.
SweepHit sampled_sweep_hit(const Curve& curve, const Ray& ray, double radius_scale = 1, bool open = false);

}  // namespace strandlab::testing
