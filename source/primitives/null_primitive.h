// A measuring aid: boxes of the exact cubic and a shader that never hits. Its time is the floor of every
// primitive with the same boxes.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

Primitive null_primitive();

}  // namespace strandlab
