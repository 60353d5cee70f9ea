// The C++ versions of the text that shades triangle strips on the GPU.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

/// Ids of the specialization constants of dots.rchit.
enum DotsConstant : uint32_t { dots_round_normals = 16, dots_round_offset = 17, dots_width_factor = 18 };

/// Index, in 32-byte shading records, of the joint where a leaf's piece starts.
uint32_t dots_first_joint(const Geometry& geometry, Leaf leaf);

CpuIntersectors dots_cpu();

}  // namespace strandlab
