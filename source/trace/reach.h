// Which strands of a scene a set of rays may meet: all others need not be built for it.
#pragma once

#include "scene/rays.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// For each model, 1 for each strand that some ray may meet in some instance. 0 means that no primitive on
/// any device reports a hit of it: no ray passes, between its tmin and tmax, a box of one of the strand's
/// curves that is wider than these by 64 float roundings of everything on the way to a device's own test
/// (coordinates, origins, the transform and its inverse). 1 may be too many: rays are told apart by the cells
/// of a grid (trace/reach_grid.h). Invalid rays meet nothing. Rays and transforms beyond what floats can be
/// trusted with (directions outside 1e-15 to 1e15, an inverse that is not finite) reach everything. Relies on
/// primitives keeping within widest_primitive radii of their curves, which the conformance tests check.
std::vector<std::vector<uint8_t>> strands_within_reach(const Scene& scene, std::span<const Ray> rays);

}  // namespace strandlab
