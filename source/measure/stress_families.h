// Families of pairs of a strand and a ray, each hard in its own way: what intersectors are stressed with.
#pragma once

#include "base/random.h"
#include "scene/rays.h"
#include "strands/bezier.h"
#include "strands/curves.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// What distinguishes a family. Control polygons have a length of about 1 before `unit`, so that radii and
/// distances count curve lengths. About three of four rays are aimed to hit.
struct StressFamily {
    /// cusp: exact cusps and self-crossing loops; point: all control points equal; nested: the radius falls
    /// faster than the curve is long, so that balls lie within balls.
    enum class Shape { smooth, degenerate, cusp, point, nested };
    /// rays as a driver makes them for an instance: to the world and back in float, by a transform that
    /// stretches (and mirrors).
    enum class Instance { none, stretched, mirrored };

    std::string name, help;
    /// The family of the published figures that this one is held to: itself, or the one that it equals but
    /// for a change that exact arithmetic would not notice.
    std::string figures = {};
    /// Not empty: why float arithmetic cannot be held to anything here. Reported, not judged.
    std::string unresolvable = {};

    double turn_low = 0, turn_high = 60;           // degrees between the first and the last edge
    double radius_low = 1e-3, radius_high = 3e-2;  // at the root, log-uniform
    double taper_low = 0.8, taper_high = 1.2;      // tip radius / root radius
    double distance_low = 2, distance_high = 10;   // from the origin to the curve
    double offset = 0;                             // of curve and ray together, from the world's origin
    double tilt_low = 0, tilt_high = 0;            // radians between ray and tangent; 0: any direction
    double lateral_low = 0, lateral_high = 1.3;    // distance of the ray from the axis, in radii
    double length_low = 0.5, length_high = 2;      // of the direction; log-uniform where it spans decades
    double unit = 1;                               // scale of everything
    uint32_t curves = 1;                           // of a strand
    double kink = 0;                               // degrees, at most, between curves of a strand
    Shape shape = Shape::smooth;
    Instance instance = Instance::none;
    bool inside = false;        // the ray starts within the tube
    bool returns = false;       // and is aimed at another part of the strand
    bool at_joints = false;     // the ray is aimed at a joint
    bool axis_aligned = false;  // directions along axes and diagonals
    bool short_ray = false;     // tmin or tmax lies near the surface
    bool lattice = false;       // the pairs of structured_pair(), in turn

    bool is_resolvable() const { return unresolvable.empty(); }
};

/// All families, in the order of reports.
std::span<const StressFamily> stress_families();

/// The family of that name, or an Error (usage) that suggests the nearest.
const StressFamily& stress_family(std::string_view name);

/// A part of the surface that a ray may be aimed at: a piece of its axis with the radius, and for flat
/// strips the direction of their width (zero for round ones).
struct StressTarget {
    CurveD axis;
    glm::dvec3 width{0};
};

/// One strand and one ray. Both are float: the input itself is exact.
struct StressPair {
    std::vector<Curve> strand;
    Ray ray;
};

inline constexpr uint64_t default_stress_seed = 20180810;

/// The strand of pair number `index`, family.curves long.
std::vector<Curve> make_strand(const StressFamily& family, uint64_t seed, uint64_t index);

/// The ray of that pair, aimed at one of the targets; none: at the strand itself.
Ray make_ray(const StressFamily& family, uint64_t seed, uint64_t index,
             std::span<const StressTarget> targets = {});

/// Both, the ray aimed at the strand's own sweep.
StressPair make_pair(const StressFamily& family, uint64_t index, uint64_t seed = default_stress_seed);

/// Rays with exact relations to curves: a lattice of parallel, perpendicular and oblique rays around
/// straight, symmetric and degenerate curves, many of them exactly through the axis.
std::span<const StressPair> structured_pairs();

}  // namespace strandlab
