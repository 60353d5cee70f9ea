// What a level of detail costs in pictures: how they differ from those of all the hair at the same distance.
#pragma once

#include "scene/hits.h"
#include "scene/rays.h"
#include "trace/camera.h"

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// A model seen from a distance: the camera moved back by `times` with the field of view narrowed so that the
/// hair keeps filling the picture, which has 1 / times as many pixels a side. As many rays at every distance.
struct DistantView {
    Camera camera;
    uint32_t width = 1, height = 1, samples = 1;
};

/// The view of `times` the camera's distance; samples is a pixel's at distance 1.
DistantView distant_view(const Camera& camera, uint32_t width, uint32_t height, uint32_t samples,
                         double times);

/// Differences of pictures with less detail from pictures with all of it. Per ray nothing can be said: the
/// strands differ. Hits of samples consecutive rays make a pixel.
struct DetailError {
    double coverage = 0;       // share of all rays that hit, full detail
    double coverage_bias = 0;  // relative difference of the covered area
    double coverage_rms = 0;   // of a pixel's coverage, over pixels that either covers
    double depth_bias = 0;     // mean difference of pixels' mean depths where both cover at least a half, m
    double transmittance = 0;  // share of shadow rays that reach the light, full detail
    double transmittance_bias = 0;  // difference of that share
};

/// Compares primary hits, and shadow hits of the same rays through both.
DetailError compare_detail(const Hits& full, const Hits& less, uint32_t samples, const Hits& full_shadow,
                           const Hits& less_shadow);

/// Shadow rays from where primary rays hit the hair, started `off` before it (so that thickened strands do
/// not hold the start).
Rays detail_shadow_rays(const Rays& primary, const Hits& hits, const glm::dvec3& to_light, float off);

}  // namespace strandlab
