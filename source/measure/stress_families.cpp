#include "measure/stress_families.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace strandlab {
namespace {

using Family = StressFamily;

constexpr const char* too_thin =
    "8 ulp of a coordinate of one length are more than a tenth of the radius: the place of the surface is "
    "not known in float";

std::vector<Family> shapes() {
    return {
        {.name = "gentle", .help = "turns up to 60 degrees, radius / length 1e-3 to 3e-2"},
        {.name = "curl", .help = "turns of 90 to 200 degrees", .turn_low = 90, .turn_high = 200},
        {.name = "taper",
         .help = "tips thinner than half the root",
         .radius_low = 1e-2,
         .radius_high = 1e-1,
         .taper_low = 0,
         .taper_high = 0.5},
        {.name = "hard taper",
         .help = "short thick cones",
         .radius_low = 0.1,
         .radius_high = 0.3,
         .taper_low = 0,
         .taper_high = 0.3},
        {.name = "zero tip",
         .help = "radius exactly 0 at the tip",
         .figures = "taper",
         .radius_low = 1e-2,
         .radius_high = 1e-1,
         .taper_low = 0,
         .taper_high = 0},
        {.name = "degenerate",
         .help = "zero tangents at ends, folds on a line, closed loops, equal inner points",
         .shape = Family::Shape::degenerate},
        {.name = "cusp",
         .help = "exact cusps and self-crossing loops",
         .figures = "degenerate",
         .shape = Family::Shape::cusp},
        {.name = "point",
         .help = "all control points equal",
         .figures = "degenerate",
         .taper_low = 1,
         .taper_high = 1,
         .shape = Family::Shape::point},
        {.name = "nested",
         .help = "radius falls faster than the curve is long: balls within balls",
         .figures = "hard taper",
         .radius_low = 0.3,
         .radius_high = 0.6,
         .taper_low = 0,
         .taper_high = 0.2,
         .lateral_high = 2.5,
         .shape = Family::Shape::nested},
        {.name = "fat curl",
         .help = "radius beyond the radius of curvature",
         .turn_low = 120,
         .turn_high = 200,
         .radius_low = 0.3,
         .radius_high = 0.6},
        {.name = "joints",
         .help = "rays at the joints of three smoothly connected curves",
         .figures = "gentle",
         .curves = 3,
         .at_joints = true},
        {.name = "kinks",
         .help = "rays at joints that turn up to 90 degrees",
         .figures = "gentle",
         .curves = 3,
         .kink = 90,
         .at_joints = true},
    };
}

std::vector<Family> rays() {
    return {
        {.name = "near-parallel",
         .help = "1e-3 to 1e-1 radians from the tangent",
         .tilt_low = 1e-3,
         .tilt_high = 1e-1},
        {.name = "grazing",
         .help = "past the silhouette by at most 1.5e-3 radii",
         .lateral_low = 1 - 1.5e-3,
         .lateral_high = 1 + 1.5e-3},
        {.name = "inside", .help = "starts within the tube: hits are exceptions", .inside = true},
        {.name = "inside out",
         .help = "starts within the tube, towards another part of the strand",
         .inside = true,
         .returns = true},
        {.name = "short rays",
         .help = "tmin or tmax within two radii of the surface",
         .figures = "gentle",
         .short_ray = true},
        {.name = "axis-aligned",
         .help = "directions along axes and diagonals",
         .figures = "gentle",
         .axis_aligned = true},
        {.name = "structured",
         .help = "exactly parallel, perpendicular, through the axis, around symmetric curves",
         .lattice = true},
        {.name = "not unit",
         .help = "lengths of the direction from 1e-9 to 1e9",
         .figures = "gentle",
         .length_low = 1e-9,
         .length_high = 1e9},
        {.name = "stretched",
         .help = "as transformed rays: instances stretched by 0.1 to 10 along any axes",
         .figures = "gentle",
         .instance = Family::Instance::stretched},
        {.name = "mirrored",
         .help = "as transformed rays: stretched and mirrored instances",
         .figures = "gentle",
         .instance = Family::Instance::mirrored},
    };
}

std::vector<Family> scales() {
    std::vector<Family> all;
    for (int e = 1; e <= 7; ++e) {
        Family f{.name = fmt::format("r/L=1e-{}", e), .help = "radius / length"};
        f.radius_low = f.radius_high = std::stod(fmt::format("1e-{}", e));
        if (e == 1) f.figures = "r/L=1e-2";
        if (e > 5) f.unresolvable = too_thin;
        all.push_back(f);
    }
    for (int e = 2; e <= 6; ++e) {
        Family f{.name = fmt::format("far 1e{}", e), .help = "ray origins so many lengths away"};
        f.distance_low = f.distance_high = std::stod(fmt::format("1e{}", e));
        f.figures = e == 3 ? "far 1e2" : e == 5 ? "far 1e4" : "";
        all.push_back(f);
    }
    for (int e = 2; e <= 6; ++e) {
        Family f{.name = fmt::format("offset 1e{}", e),
                 .help = "curve and ray so many lengths from the world's origin"};
        f.offset = std::stod(fmt::format("1e{}", e));
        f.figures = "offset 1e4";
        all.push_back(f);
    }
    for (const int e : {-9, -6, -3, 3, 6, 9}) {
        Family f{.name = fmt::format("unit 1e{}", e), .help = "scene in units of this size"};
        f.unit = std::stod(fmt::format("1e{}", e));
        f.figures = "gentle";
        all.push_back(f);
    }
    return all;
}

std::vector<Family> make_families() {
    std::vector<Family> all;
    for (const auto& part : {shapes(), rays(), scales()}) all.insert(all.end(), part.begin(), part.end());
    for (Family& family : all)
        if (family.figures.empty()) family.figures = family.name;
    return all;
}

}  // namespace

std::span<const StressFamily> stress_families() {
    static const std::vector<Family> all = make_families();
    return all;
}

const StressFamily& stress_family(std::string_view name) {
    std::vector<std::string> names;
    for (const Family& family : stress_families()) {
        if (family.name == name) return family;
        names.push_back(family.name);
    }
    const auto guess = nearest(std::string(name), names);
    fail(ExitCode::usage, "no stress family '{}'{}; there are {}", name,
         guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(names, "and"));
}

}  // namespace strandlab
