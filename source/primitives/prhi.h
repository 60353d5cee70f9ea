// Phantom ray-hair intersector (Reshetov & Luebke, HPG 2018) on the exact cubics.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

Primitive prhi();

}  // namespace strandlab
