// Hair as files hold it: polylines with a radius per point.
#pragma once

#include "strands/curves.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace strandlab {

/// Strands of one model, root first. Points are (x, y, z, radius); a radius below 0 marks "the file
/// has none". Strand s owns the points [first_point[s], first_point[s + 1]).
struct Strands {
    std::vector<glm::vec4> points;
    std::vector<uint32_t> first_point{0};  // one more entry than there are strands

    size_t size() const { return first_point.size() - 1; }
};

/// How the points of a strand become curves.
enum class Basis { centripetal, uniform, linear, bspline };

/// What conversion does besides: radii where the file has none, unit scale.
struct CurveOptions {
    Basis basis = Basis::centripetal;
    float root_radius = 35e-6f;  // scene units, after the unit scale; used where a file has no radii
    float tip_radius = 10e-6f;
    bool override_radii = false;  // use the two radii even where the file has its own
    float unit_scale = 1.0f;      // file units to scene units; also multiplies the file's own radii
};

/// What was passed over on the way, for one warning line each.
struct ImportReport {
    size_t short_strands = 0;    // strands with fewer than two distinct points
    size_t repeated_points = 0;  // consecutive points that are equal in float32
    size_t negative_radii = 0;   // set to 0
    size_t gaps = 0;             // neighbours in a strand of a curve file that do not share an end point
    bool radii_from_options = false;
};

/// One line for everything in the report that the user should know; none when all is well.
std::vector<std::string> warnings(const ImportReport& report, const CurveOptions& options);

/// Largest coordinate and radius that is accepted: squares and fourth powers of differences, which every
/// intersector forms, must stay finite.
constexpr float largest_coordinate = 1e9f;

/// Whether all of x, y, z are finite and within largest_coordinate; a radius likewise, 0 and negative
/// ("none") included.
bool is_usable(const glm::vec4& point);

/// Throws Error (usage) when a radius or the unit scale is out of range.
void check_options(const CurveOptions& options);

/// Makes the curves of all strands, one between every two neighbouring distinct points: cubic
/// Catmull-Rom with centripetal knots (Yuksel, Schaefer and Keyser 2011, "Parameterization and
/// applications of Catmull-Rom curves") or uniform ones, straight lines, or a uniform B-spline that has
/// the points as control points (its curves pass near them, and through the first and the last). Ends
/// are extended by the reflected point 2 P0 - P1. The radius is interpolated like a fourth coordinate and
/// kept within [0, twice the largest radius of the points involved]. Two points give the line with evenly
/// spaced control points. A strand with fewer than two distinct points gives no curve and no strand.
/// Where a point has no radius, it is interpolated from root to tip by point index. Throws Error
/// (bad_input) naming strand and point for numbers that are not usable, or above 2^32 - 1 curves, and
/// Error (usage) for options out of range.
Curves make_curves(const Strands& strands, const CurveOptions& options, ImportReport& report);

/// Applies unit scale and override_radii to curves that were not made by make_curves (curve files).
/// Throws as make_curves does.
void apply_options(Curves& curves, const CurveOptions& options, ImportReport& report);

}  // namespace strandlab
