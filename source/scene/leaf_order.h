// The order of leaves in a build's input. Some drivers sort; on lavapipe (Mesa 25.0) the order is the tree:
// it splits the leaves [first, last] at (first + last) / 2, recursively.
#pragma once

#include "scene/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// Object-median order with exactly those splits: the first ceil(n/2) leaves are one side of the plane, of
/// the three axes, whose two halves have the smaller summed box area; then the same in both halves.
/// order[i] is the old index of the new leaf i. The same for any number of threads.
std::vector<uint32_t> median_order(std::span<const Box> boxes);

/// The same order from the program's cache, where an earlier run has computed it; few boxes are not kept.
struct KnownOrder {
    std::vector<uint32_t> order;
    bool was_cached = false;
};
KnownOrder known_median_order(std::span<const Box> boxes);

}  // namespace strandlab
