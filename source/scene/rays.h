// Rays as they are stored, traced and hashed.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// One ray origin + t direction, tmin <= t <= tmax. The direction need not have unit length; t counts
/// multiples of it. Layout: 32 bytes, as in ray files and in the device's ray buffer.
struct Ray {
    glm::vec3 origin{0};
    float tmin = 0;
    glm::vec3 direction{0, 0, 1};
    float tmax = 1e30f;
};
static_assert(sizeof(Ray) == 32);

/// A set of rays, the same for every primitive. width x height is the launch shape (row-major images
/// have their own; other sets any shape whose product is at least the count).
struct Rays {
    std::string name;  // primary, secondary, shadow or a file name
    std::vector<Ray> rays;
    uint32_t width = 0, height = 0;
};

/// Whether Vulkan defines what tracing it does: all numbers finite, direction not zero,
/// 0 <= tmin <= tmax (tmax may be +infinity).
bool is_valid(const Ray& ray);

/// Replaces every invalid ray by a valid one that misses everything (a single point far outside);
/// returns how many there were, for the message that they count as misses.
size_t disable_invalid(std::vector<Ray>& rays);

/// Largest finite coordinate of any origin: what boxes are padded for.
float extent_of(std::span<const Ray> rays);
inline float extent_of(const Rays& rays) { return extent_of(rays.rays); }

/// Content hash.
uint64_t hash(const Rays& rays);

}  // namespace strandlab
