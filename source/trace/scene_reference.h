// Reference hits of whole scenes, kept in the cache: a sweep over primitives pays for them once.
#pragma once

#include "scene/scene.h"
#include "trace/reference.h"

#include <functional>
#include <span>

namespace strandlab {

/// The surface of each model of a scene.
std::vector<Surface> surfaces_of(const Scene& scene, const std::function<Surface(const Curves&)>& make);

/// The common reference of a scene: the swept spheres of its curves with this cap mode.
std::vector<Surface> common_surfaces(const Scene& scene, Caps caps);

/// Content hash of a surface.
uint64_t hash(const Surface& surface);

/// Reference hits alone, where nobody asks which rays are decisive: what other ray sets start from.
std::vector<ReferenceHit> make_scene_hits(const Scene& scene, std::span<const Surface> surfaces,
                                          std::span<const Ray> rays);

/// Reference hits and decisive rays for a scene of instances; curves: all_curves(scene), for the strands.
/// Read from the cache where the same surfaces, instances and rays were traced before.
Reference make_scene_reference(const Scene& scene, std::span<const Surface> surfaces, const Curves& curves,
                               std::span<const Ray> rays);

}  // namespace strandlab
