// How primitives cut curves into pieces: equal parameter intervals, by count or by tolerance.
#pragma once

#include "base/parameters.h"
#include "scene/geometry.h"
#include "scene/surface.h"
#include "strands/bezier.h"

#include <vector>

namespace strandlab {

/// The parameters "segments" and "tolerance" of primitives made of straight pieces.
std::vector<ParameterInfo> straight_piece_parameters(uint32_t default_segments);

/// Pieces for each curve: `segments`, or, where tolerance > 0, as many as keep the chord within
/// tolerance x the curve's smallest radius of the curve: ceil(sqrt(max|C''| / (8 tolerance r)))
/// (intersectors.md section 8). At least 1, at most Leaf::max_pieces.
std::vector<uint32_t> straight_pieces(const Curves& curves, const Parameters& parameters);

/// The first leaf of every curve, and the number of all leaves at the end.
std::vector<size_t> leaf_offsets(const std::vector<uint32_t>& pieces);

/// Writes leaves[first..] for the pieces of one curve, with the strand flags of its ends.
void fill_leaves(const Curves& curves, uint32_t curve, uint32_t pieces, Leaf* leaves);

/// The leaf table of all curves; sets uniform_pieces when every curve has the same count and flags are
/// not needed.
void make_leaves(const Curves& curves, const std::vector<uint32_t>& pieces, bool needs_flags,
                 Geometry& geometry);

/// Balls swept along straight pieces with linear radius (round cones), through the joints of the curves.
Surface straight_surface(const Curves& curves, const std::vector<uint32_t>& pieces, Caps caps);

/// Point i of n + 1 equally spaced in u, rounded to float: shared bit for bit by neighbouring pieces.
glm::vec4 joint(const Curve& curve, uint32_t i, uint32_t n);

}  // namespace strandlab
