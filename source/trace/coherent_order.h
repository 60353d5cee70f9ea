// An order of rays in which neighbours start and go alike, so that what one has brought into the caches is
// there for the next.
#pragma once

#include "scene/rays.h"

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// A permutation of the rays along a Morton curve through their origins, then their directions; invalid rays
/// go anywhere. The same for any number of threads. Few rays stay as they are.
std::vector<uint32_t> coherent_order(std::span<const Ray> rays);

}  // namespace strandlab
