// How many leaves each curve gets when memory is limited.
#pragma once

#include "strands/curves.h"

#include <cstdint>
#include <vector>

namespace strandlab {

/// The most leaves that all curves of a model may have together, on average for each. With equal counts for
/// all curves a device may need no table of leaves, and so more of them fit.
struct LeafBudget {
    double leaves = 0;          // of curves with counts of their own; 0: no budget
    double uniform_leaves = 0;  // of curves that all have the same count

    bool is_set() const { return leaves > 0; }
};

/// Leaves for each curve, at least `least` (each one of 1, 2, 4, ... 64), together within the budget; where
/// not even `least` is, just that. A ray enters a leaf with a chance in proportion to the surface of its box:
/// the next leaf goes to the curve where it takes away most of it. Where equal counts are about as good they
/// are chosen: they spare the fetch of a table's entry at every leaf.
std::vector<uint32_t> pieces_within(const Curves& curves, const std::vector<uint32_t>& least,
                                    const LeafBudget& budget);

/// Half the surface of the boxes of n equal pieces together: ends, radii, and what the curve bends beyond its
/// chord, bounded.
double box_surface(const Curve& curve, uint32_t n);

}  // namespace strandlab
