// Linear swept spheres: round cones between equally spaced points of each curve.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

/// One round cone as the shader reads it, (x, y, z, radius) at both ends: 32 bytes.
struct LssRecord {
    glm::vec4 start, end;
};

Primitive lss();

}  // namespace strandlab
