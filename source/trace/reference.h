// Reference hits of a ray set, and which of them float arithmetic can be held to.
#pragma once

#include "strands/curves.h"
#include "trace/oracle.h"

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
/// for the surface with larger and with smaller radii. Only misjudged decisive rays are errors. The place of
/// a decisive ray is decisive too when the hit of neither variation moves by more than 0.3 radii: a ray that
/// grazes one part of a strand before it hits another has a decisive strand but no decisive place.
struct Reference {
    std::vector<ReferenceHit> hits;
    std::vector<uint8_t> decisive;
    std::vector<uint8_t> decisive_place;
    double margin = 0;  // half of the surface's pieces were varied by at most this, relative to their radii
};

/// The relative change of the radii of half of the surface's pieces that a margin comes to: its own, or more
/// where the radii are thin beside the ulps of the coordinates. The margin's own for an empty surface.
double relative_margin(const Surface& surface, const DecisiveMargin& margin = {});

/// What the two variations of the surface say about the hit of a ray.
struct Decided {
    bool strand = false;  // hit or miss, and the strand of the same instance
    bool place = false;   // that, and the hit stays within 0.3 radii
};
Decided decided(const Ray& ray, const Curves& curves, const ReferenceHit& hit, const ReferenceHit& larger,
                const ReferenceHit& smaller);

/// Traces the rays against the surface and its two variations, in parallel. curves gives the strands that
/// the surface's curve numbers belong to.
Reference make_reference(const Surface& surface, const Curves& curves, std::span<const Ray> rays,
                         const DecisiveMargin& margin = {});

}  // namespace strandlab
