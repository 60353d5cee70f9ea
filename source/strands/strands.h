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
    size_t short_strands = 0;     // strands with fewer than two distinct points
    size_t repeated_points = 0;   // consecutive points closer than float32 can tell apart
    size_t negative_radii = 0;    // set to 0
    bool radii_from_options = false;
};

/// Makes the curves of all strands (Catmull-Rom with centripetal or uniform knots, line, or uniform
/// B-spline; intersectors.md section 8). A strand with fewer than two distinct points gives no curve.
Curves make_curves(const Strands& strands, const CurveOptions& options, ImportReport& report);

}  // namespace strandlab
