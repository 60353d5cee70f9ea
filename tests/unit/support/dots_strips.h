// Strips for tests: strands to build, and their leaves one by one.
#pragma once

#include "base/random.h"
#include "primitives/dots.h"

#include <type_traits>

namespace strandlab::testing {

inline PrimitiveChoice dots_choice(const std::string& options) { return parse_primitive("dots" + options); }

inline Geometry built_dots(const Curves& curves, const std::string& options = "") {
    const PrimitiveChoice dots = dots_choice(options);
    return dots.primitive->build(curves, dots.options);
}

inline Curve line(const glm::vec4& a, const glm::vec4& b) {
    return {a, glm::mix(a, b, 1.0f / 3), glm::mix(a, b, 2.0f / 3), b};
}

/// Strands of a few joined curves each, with changing radii.
inline Curves random_curves(uint64_t seed, uint32_t strands, uint32_t per_strand, double radius) {
    Curves curves;
    for (uint32_t s = 0; s < strands; ++s) {
        Random random(seed, 0, s);
        curves.strands.push_back({static_cast<uint32_t>(curves.curves.size()), per_strand});
        glm::vec4 last(random.signed_unit(), random.signed_unit(), random.signed_unit(), radius);
        for (uint32_t c = 0; c < per_strand; ++c) {
            Curve curve;
            curve[0] = last;
            for (int k = 1; k < 4; ++k)
                curve[k] = curve[k - 1] + glm::vec4(0.3 * random.signed_unit(), 0.3 * random.signed_unit(),
                                                    0.3, -radius * 0.2 / per_strand);
            last = curve[3];
            curves.curves.push_back(curve);
        }
    }
    return curves;
}

/// Whether the C++ version meets leaf i.
template <class Real>
bool test_leaf(const Geometry& geometry, size_t i, const Ray& ray, LeafHit<Real>& hit) {
    const CpuIntersectors& cpu = primitive_named("dots").cpu;
    if constexpr (std::is_same_v<Real, float>)
        return cpu.single(geometry, i, ray, ray.tmax, hit);
    else
        return cpu.precise(geometry, i, ray, double(ray.tmax), hit);
}

/// A ray from a random side at that distance to within scatter of the target.
inline Ray ray_at(Random& random, const glm::vec3& target, double distance, double scatter) {
    const glm::dvec3 from(random.signed_unit(), random.signed_unit(), random.signed_unit());
    Ray ray;
    ray.origin = glm::vec3(glm::dvec3(target) + glm::normalize(from) * distance);
    const glm::dvec3 aim =
        glm::dvec3(target) +
        scatter * glm::dvec3(random.signed_unit(), random.signed_unit(), random.signed_unit());
    ray.direction = glm::vec3((aim - glm::dvec3(ray.origin)) * random.range(0.3, 3) / distance);
    ray.tmax = 1e30f;
    return ray;
}

}  // namespace strandlab::testing
