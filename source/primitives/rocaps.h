// Roving capsules: short round cones between points of the exact cubic, chosen per ray.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

/// Roving capsules (Reshetov & Hart 2024), as published and verified on the true curve. A curve's record is
/// its four control points, 64 bytes; the sign bits of the first and the last radius say that the curve
/// begins and ends its strand.
Primitive rocaps();

}  // namespace strandlab
