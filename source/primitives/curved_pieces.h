// What primitives on the exact cubic share: leaves over sub-intervals of u, tight boxes, 64-byte records.
#pragma once

#include "primitives/pieces.h"
#include "primitives/primitive.h"

#include <vector>

namespace strandlab {

/// The parameter "splits": leaves per curve.
ParameterInfo splits_parameter(uint32_t default_splits);

/// Leaves for each curve: `splits`, raised for a curve that turns so far that a piece would turn more than
/// max_turn radians (bound by the control polygon of each piece). With a budget, as many as are of most use
/// within it.
std::vector<uint32_t> curved_pieces(const Curves& curves, uint32_t splits, double max_turn,
                                    const LeafBudget& budget);

/// Leaves, tight boxes of the swept balls on each sub-interval, and one record per curve: its four
/// control points (x, y, z, radius), 64 bytes, of which a device keeps 48 where the next curve of the strand
/// begins.
Geometry build_curved(const Curves& curves, const std::vector<uint32_t>& pieces, bool needs_flags);

/// The surface that those records decode to: one cubic piece per curve.
Surface curved_surface(const Curves& curves, Surface::Sweep sweep, Caps caps);

/// The record of the curve that a leaf belongs to.
inline const Curve& curve_record(const Geometry& geometry, const Leaf& leaf) {
    return reinterpret_cast<const Curve*>(geometry.curve_records.bytes.data())[leaf.curve];
}

}  // namespace strandlab
