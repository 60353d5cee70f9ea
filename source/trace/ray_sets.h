// The rays that primitives are compared by: made once, the same for every primitive.
#pragma once

#include "scene/hits.h"
#include "scene/rays.h"
#include "strands/curves.h"
#include "trace/camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace strandlab {

/// Shape of a picture: rays of pixel (x, y) are the samples consecutive ones from (y width + x) samples.
struct PictureSize {
    uint32_t width = 1024, height = 1024, samples = 1;

    size_t rays() const { return size_t(width) * height * samples; }
    double aspect() const { return double(width) / height; }
};

/// Primary rays of a pinhole camera: row-major, top row first, the samples of a pixel side by side (the
/// launch shape is width samples x height), origins at the eye, directions of unit length, tmin 0. One
/// sample goes through the centre of its pixel; several are spread over it by the R2 sequence (Roberts
/// 2018), shifted at random per pixel (Cranley and Patterson 1976), so that their mean is unbiased for
/// the pixel's box filter. Throws Error (usage) for an empty picture or more than 2^32 - 1 rays.
Rays primary_rays(const Camera& camera, const PictureSize& size, uint64_t seed = 1);

/// The reference hits of primary rays on the common surface, hits[i] of rays[i]: where other sets start.
struct PrimaryHits {
    std::span<const Ray> rays;
    std::span<const ReferenceHit> hits;
};

/// Rays of one diffuse bounce: one from each hit, in the order of the primary rays, cosine-distributed about
/// the normal. The start is o + t d in double, moved along the normal by max(1 % of the radius, 4 ulp of its
/// largest coordinate), so that rounding it to float leaves it outside. Hits of rays that start inside the
/// surface, and hits that are not finite, have none.
Rays diffuse_rays(const PrimaryHits& primary, uint64_t seed = 1);

/// Ambient-occlusion rays: from the same points, cosine-distributed about the normal (other numbers than the
/// diffuse rays'), that end after a tenth of the diagonal of the box around all starts. Only whether they hit
/// anything counts.
Rays ambient_rays(const PrimaryHits& primary, uint64_t seed = 1);

/// Shadow rays: from the same points towards a directional light (unit vector to the light). Hits that
/// face away from it have none: the surface is dark there without a ray.
Rays shadow_rays(const PrimaryHits& primary, const glm::dvec3& to_light);

/// Interior rays: count rays that start beside a random point of a random strand (every strand alike,
/// then every curve of it, then every parameter), 1 % of the radius outside the swept sphere, and leave
/// cosine-distributed about the normal there. Incoherent by construction. Throws Error (bad_input)
/// without strands.
Rays interior_rays(const Curves& curves, size_t count, uint64_t seed = 1);

/// Grazing rays: count rays that pass a random point of a random strand (chosen as for interior rays) at 0.95
/// to 1.05 radii from its axis, along a random tangent of the surface there, and start 20 radii before it:
/// where intersectors are least certain. Throws Error (bad_input) without strands.
Rays grazing_rays(const Curves& curves, size_t count, uint64_t seed = 1);

/// Puts the rays into a random order: the same coherent work, with coherence taken away.
void shuffle(Rays& rays, uint64_t seed);

/// Sets width and height to an almost square shape of at least as many rays (rows of a multiple of 32).
void set_launch_shape(Rays& rays);

/// Rays that come from outside, and how many of them were invalid and now miss everything.
struct LoadedRays {
    Rays rays;
    size_t invalid = 0;
};

/// Rays from the floats of a file: values holds 8 per ray (ox, oy, oz, tmin, dx, dy, dz, tmax). Invalid
/// rays (see is_valid) are disabled and counted. Throws Error (bad_input) when the count is no multiple
/// of 8 or is 0; name is for messages and becomes the name of the set.
LoadedRays rays_from_floats(std::string name, std::span<const float> values);

/// Rays of an .npy file, float32 [M, 8]. Throws Error (bad_input) naming file, place and value.
LoadedRays load_rays(const std::string& path);

/// What the maker of a named ray set may use.
struct RaySetInput {
    const Curves& curves;
    Camera camera;
    PictureSize size;              // of primary rays; sets without a picture make size.rays() rays
    glm::dvec3 to_light{0, 1, 0};  // unit, world space
    uint64_t seed = 1;
    bool shuffled = false;
    PrimaryHits primary{};  // filled in for sets that need it
};

/// One ray set by name. Adding a set is one line in the table of ray_sets.cpp.
struct RaySetInfo {
    std::string_view name, help;
    /// input.primary must hold the reference hits of primary_rays(camera, size, seed).
    bool needs_primary_hits;
    bool hit_or_miss_only;  // traced up to any hit
    Rays (*make)(const RaySetInput& input);
};

/// All named ray sets, in the order in which reports list them.
std::span<const RaySetInfo> ray_sets();

/// The set of a name ("secondary" is diffuse's old one); throws Error (usage) with the nearest name and the
/// list.
const RaySetInfo& ray_set_named(std::string_view name);

/// Makes a set with its name; shuffled if asked for: then its name says so, "primary shuffled".
Rays make_rays(const RaySetInfo& set, const RaySetInput& input);

}  // namespace strandlab
