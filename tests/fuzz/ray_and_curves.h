// One ray and a few curves from the bytes of a fuzzer.
#pragma once

#include "fuzz/input_reader.h"
#include "scene/rays.h"
#include "strands/curves.h"

namespace strandlab::fuzz {

/// Where the numbers come from.
enum class Numbers {
    bits,     // any bit pattern is a float
    grid,     // small multiples of 1/16: exactly parallel, perpendicular, coincident, tangent
    scaled,   // 16 bits times a power of two from 2^-90 to 2^29, one for the ray and one for the curves
    ordinary  // hair: a curve about 1 long, radii below 0.1, rays towards it from a distance of 10^0 to 10^5
};

struct RayAndCurves {
    Ray ray;        // not necessarily valid
    Curves curves;  // one strand; legal: finite, below largest_coordinate, radii >= 0
    Numbers numbers;
};

RayAndCurves take_ray_and_curves(InputReader& reader);

/// Inputs of take_ray_and_curves, one of each kind of numbers.
std::vector<std::string> ray_and_curves_seeds();

}  // namespace strandlab::fuzz
