// Pictures of primary hits: simple lighting that makes hair look like hair, and every fact as a layer.
#pragma once

#include "report/images.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace strandlab {

/// How hits are lit. Colours are linear (Rec. 709 primaries).
struct ShadingOptions {
    uint32_t width = 0, height = 0, samples = 1;  // shape of the primary rays
    glm::dvec3 to_light{0, 1, 0};                 // unit, world space
    glm::vec3 hair{0.21f, 0.105f, 0.050f};
    glm::vec3 background_top{0.80f, 0.84f, 0.88f}, background_bottom{0.58f, 0.60f, 0.63f};
    float variation = 0.6f;  // relative spread of brightness between strands, 0 to 1
    float ambient = 0.35f;   // light from everywhere, relative to the light
};

/// An image of the hits of primary rays; rays, hits and (unless empty) normals correspond one to one and
/// hold samples rays per pixel, side by side. Pixel colour is the mean over the samples of
///   - Kajiya and Kay 1989 for light along a strand: diffuse sin(tangent, light), with the two shifted
///     highlights of Scheuermann 2004 (one white, one in the strand's colour),
///   - darkened towards the root and inside of the hair's volume, by light_visible[i] in [0, 1] for the
///     direct part when the caller has traced shadow rays (one per ray; empty: all visible),
///   - each strand in its own brightness and warmth, from a hash of its number and of its root's place,
/// over a soft gradient. Layers besides R, G, B: depth.Z (ray parameter), normal.X/Y/Z, u (curve
/// parameter), id.curve, id.strand (0xFFFFFFFF: none) of the nearest sample that hit, and mask (number of
/// samples that hit). A hit whose curve is not in curves counts as a miss. Where a ray misses, behind[i]
/// (unless empty or NaN) is seen instead of the gradient.
Image shade(const Rays& rays, const Hits& hits, const Curves& curves, const ShadingOptions& options,
            std::span<const float> light_visible = {}, std::span<const glm::vec3> behind = {});

}  // namespace strandlab
