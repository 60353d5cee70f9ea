// Reference hits of a ray set, and which of them float arithmetic can be held to.
#pragma once

#include "trace/oracle.h"

#include "strands/curves.h"

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// How much the surface is varied to find out which rays are decisive.
struct DecisiveMargin {
    double radius = 1e-3;  // relative change of all radii, in both directions
    double ulps = 8;       // at least so many float ulps of the largest segment-local coordinate
    double ends = 1e-3;    // parameter by which open and flat ends move
};

/// One reference hit per ray. A ray is decisive when hit or miss, and the strand that is hit, are the same
/// for the surface with larger and with smaller radii. Only misjudged decisive rays are errors.
struct Reference {
    std::vector<ReferenceHit> hits;
    std::vector<uint8_t> decisive;
};

/// Traces the rays against the surface and its two variations, in parallel. curves gives the strands that
/// the surface's curve numbers belong to. The hits have no wrong-place test: whoever compares applies it.
Reference make_reference(const Surface& surface, const Curves& curves, std::span<const Ray> rays,
                         const DecisiveMargin& margin = {});

}  // namespace strandlab
