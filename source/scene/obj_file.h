// Triangles of Wavefront OBJ files: opaque bodies that hair grows on.
#pragma once

#include "base/byte_source.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace strandlab {

/// Corners of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<glm::vec3, 3>;

/// Reads v and f records (v/vt/vn too, negative numbers count back; polygons become fans) and passes over the
/// others. Throws Error (bad_input) naming file, line and value: no number, not finite, no such vertex, a
/// face of fewer than three, no face at all.
std::vector<Triangle> load_obj(const ByteSource& source);

}  // namespace strandlab
