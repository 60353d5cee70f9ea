// NAME: what it is, in one line, with the paper or note that it comes from.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

/// One leaf as the shader reads it, (x, y, z, radius) at both ends of a straight piece: 32 bytes.
struct TypeRecord {
    glm::vec4 start, end;
};
static_assert(sizeof(TypeRecord) == 32);

Primitive NAME();

}  // namespace strandlab
