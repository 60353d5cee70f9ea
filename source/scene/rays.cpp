#include "scene/rays.h"

#include "base/hash.h"

#include <cmath>

namespace strandlab {
namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

bool is_valid(const Ray& ray) {
    const float length_squared = glm::dot(ray.direction, ray.direction);
    return is_finite(ray.origin) && is_finite(ray.direction) && length_squared > 0 &&
           std::isfinite(length_squared) && ray.tmin >= 0 && ray.tmin <= ray.tmax;
}

size_t disable_invalid(std::vector<Ray>& rays) {
    size_t count = 0;
    for (Ray& ray : rays) {
        if (is_valid(ray)) continue;
        // A valid ray that cannot hit: its interval is one point at the largest coordinates.
        ray = {glm::vec3(1e30f), 0.0f, glm::vec3(0, 0, 1), 0.0f};
        ++count;
    }
    return count;
}

float extent_of(std::span<const Ray> rays) {
    float extent = 0;
    for (const Ray& ray : rays) {
        const glm::vec3 size = glm::abs(ray.origin);
        // Comparisons with NaN are false; what is infinite belongs to an invalid ray.
        for (int axis = 0; axis < 3; ++axis)
            if (size[axis] > extent && std::isfinite(size[axis])) extent = size[axis];
    }
    return extent;
}

uint64_t hash(const Rays& rays) { return Hash().add(std::span<const Ray>(rays.rays)).value(); }

}  // namespace strandlab
