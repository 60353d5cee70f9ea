// A slow reference for swept discs that shares nothing with any intersector: dense sampling in double.
#pragma once

#include "scene/rays.h"
#include "strands/bezier.h"

#include <optional>

namespace strandlab::testing {

/// A point where the ray enters the tube of discs.
struct DiscHit {
    double t = 0, u = 0, radius = 0;
    glm::dvec3 normal{0};  // exact, unit
};

/// The first entry (front-facing, t >= tmin) into the discs of radius scale r(u) normal to C(u), u in [a, b]
/// (which may reach a little beyond [0, 1]); no caps.
std::optional<DiscHit> first_disc_hit(const CurveD& curve, const Ray& ray, double scale = 1, double a = 0,
                                      double b = 1);

/// What the reference says about a pair, and whether that survives a change of the radii and of the open ends
/// by one part in a thousand. Only decisive answers are fair to ask of a single-precision method.
struct DiscAnswer {
    std::optional<DiscHit> hit;
    bool decisive = false;
};
DiscAnswer disc_answer(const CurveD& curve, const Ray& ray);

}  // namespace strandlab::testing
