// Self-intersection: rays that leave a primitive's own hits, and whether its intersector lets them go.
#pragma once

#include "measure/stress.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// Directions of every hit: two cosine-distributed about the primitive's normal, two grazing (the cosine
/// log-uniform from 1e-4 to 1e-1).
inline constexpr size_t spawn_directions = 4;

/// A hit of the C++ float version, and the rays that leave it.
struct SpawnPoint {
    bool usable = false;  // a finite hit with a finite normal and a radius
    SpawnPlace place;
    std::array<glm::vec3, spawn_directions> directions{};

    /// A ray with tmin = 0 that starts at this distance from the surface.
    Ray ray(size_t direction, double distance) const;
};

/// Counts over the rays of one family and primitive. A self-hit is a hit that is nearer than the oracle's
/// first one, from the same start, by more than max(r / 2, 8 ulp of t), unless nothing can decide: the oracle
/// meets the strand there from half as high a start, or the ray passes there within max(1e-3 r, 8 ulp) of
/// another part of it (radii scaled as for decisive rays).
struct SpawnTally {
    uint64_t hits = 0, rays = 0;
    uint64_t self_hits = 0;  // with the primitive's own offset
    uint64_t unmoved = 0;    // self-hits with no offset at all
    uint64_t own_hits = 0;   // of rays with the primitive's offset that meet their own strand, rightly
    /// The least offset from which on no ray has a self-hit: in radii, and in spacings of floats at the
    /// largest coordinate. Each alone is enough.
    double radii_needed = 0, ulps_needed = 0;
    /// Rays traced both ways through a hierarchy, and those whose hit or miss is another when traversal may
    /// end with the first hit.
    uint64_t shadow_rays = 0, shadow_differs = 0;
};

/// The hits of the pairs' rays with their own strands; surface: the primitive's own.
std::vector<SpawnPoint> spawn_points(const Primitive& primitive, const Geometry& geometry,
                                     const Surface& surface, const StressPairs& pairs);

/// Traces the rays of the points against their own strands with the C++ float version, at offsets from a
/// quarter of a radius (or 16 ulp) down to nothing, and through a hierarchy of all strands at once as
/// shadow rays and as closest hits.
void add_spawned(const Primitive& primitive, const Geometry& geometry, const Surface& surface,
                 const StressRange& range, std::span<const SpawnPoint> points, SpawnTally& tally);

/// The same rays at the primitive's own offset through a device, where the points come from the C++ version.
void add_spawned(const PairScene& scene, const Primitive& primitive, const Surface& surface,
                 const StressRange& range, std::span<const SpawnPoint> points, SpawnTally& tally);

}  // namespace strandlab
