// Where strands are rooted on a face: progressive blue noise on the unit square and the unit triangle.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace strandlab {

/// Points in [0, 1)^2 whose every prefix is spread evenly: weighted sample elimination (Yuksel 2015, "Sample
/// Elimination for Generating Poisson Disk Sample Sets"), halving again and again for the order. Distances
/// wrap around, so that faces beside each other show no seam. Always the same.
const std::vector<glm::vec2>& square_samples();

/// The same on the triangle x, y >= 0, x + y <= 1 (barycentric coordinates of the second and the third
/// vertex); samples repel each other through the mirrored triangle that completes the square.
const std::vector<glm::vec2>& triangle_samples();

/// Makes such a set of count points out of five times as many candidates.
std::vector<glm::vec2> eliminate_samples(size_t count, bool on_triangle, uint64_t seed);

/// How far a set is shifted on the torus where it is repeated: 0 in round 0.
glm::vec2 sample_shift(bool is_triangle, uint32_t round);

/// Root number index on a face: every face uses the set under a symmetry of its own (8 of the square, 6 of
/// the triangle), chosen by key. Beyond the set's end it is repeated, shifted on the torus.
glm::vec2 face_sample(bool is_triangle, uint32_t key, uint32_t index);

}  // namespace strandlab
