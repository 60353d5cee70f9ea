// Pairs of a ray and a curve that intersectors are tested on: random families, each hard in its own way,
// and structured ones (exactly parallel, perpendicular, through the axis, symmetric), which find faults that
// random rays never show.
#pragma once

#include "base/random.h"
#include "scene/rays.h"
#include "strands/curves.h"

#include <string>
#include <vector>

namespace strandlab::testing {

/// One ray aimed at, or just past, one curve (about three of four hit). Both are float: the input itself is
/// exact.
struct RayCurvePair {
    Curve curve;
    Ray ray;
};

/// What distinguishes a family of random pairs. Curves have control polygons of length about 1, so that radii
/// and distances count curve lengths.
struct RayFamily {
    enum class Shape { smooth, degenerate };

    std::string name;
    double turn_low = 0, turn_high = 60;           // degrees between the first and the last edge
    double radius_low = 1e-3, radius_high = 3e-2;  // at the root, log-uniform
    double taper_low = 0.8, taper_high = 1.2;      // tip radius / root radius
    double distance_low = 2, distance_high = 10;   // from the origin to the curve
    double offset = 0;                             // of curve and ray together, from the world's origin
    double tilt_low = 0, tilt_high = 0;            // radians between ray and tangent; 0: any direction
    double lateral_low = 0, lateral_high = 1.3;    // distance of the ray from the axis, in radii
    Shape shape = Shape::smooth;
    bool inside = false;  // the ray starts within the tube
};

/// All random families.
std::vector<RayFamily> ray_families();

/// The family of that name; the name must exist.
RayFamily ray_family(const std::string& name);

/// Pair number `index` of a family, the same on every machine.
RayCurvePair make_pair(const RayFamily& family, uint64_t index);

/// Rays with exact relations to curves: a lattice of parallel, perpendicular and oblique rays around
/// straight, symmetric and degenerate curves, many of them exactly through the axis.
std::vector<RayCurvePair> structured_pairs();

}  // namespace strandlab::testing
