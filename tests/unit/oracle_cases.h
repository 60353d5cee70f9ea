// Curves and rays that the tests of the reference share.
#pragma once

#include "base/random.h"
#include "scene/rays.h"
#include "scene/surface.h"
#include "strands/bezier.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <cstdlib>
#include <numbers>
#include <string_view>
#include <vector>

namespace strandlab::oracle_cases {

/// A count that grows when STRANDLAB_LONG_TESTS is set.
inline size_t count(size_t normal, size_t factor = 20) {
    const char* value = std::getenv("STRANDLAB_LONG_TESTS");
    return value && *value && *value != '0' ? normal * factor : normal;
}

inline glm::dvec3 random_direction(Random& random) {
    const double z = random.signed_unit(), angle = 2 * std::numbers::pi * random.uniform();
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(angle), s * std::sin(angle), z};
}

/// A unit vector across n.
inline glm::dvec3 across(const glm::dvec3& n, Random& random) {
    while (true) {
        const glm::dvec3 v = glm::cross(n, random_direction(random));
        if (glm::length(v) > 0.1) return glm::normalize(v);
    }
}

enum class Family { gentle, curl, taper, thin, fat, degenerate, offset, count };

inline std::string_view name_of(Family family) {
    constexpr std::string_view names[] = {"gentle", "curl", "taper", "thin", "fat", "degenerate", "offset"};
    return names[static_cast<int>(family)];
}

/// A curve of length about 1.
inline Curve random_curve(Family family, Random& random) {
    CurveD c;
    const double bend = family == Family::curl || family == Family::fat ? 0.7 : 0.08;
    const glm::dvec3 axis = random_direction(random);
    for (int i = 0; i < 4; ++i)
        c[i] = glm::dvec4(axis * (i / 3.0 - 0.5) + bend * random.uniform() * random_direction(random), 0);
    double r0 = std::pow(10.0, random.range(-3, -1.5)), r1 = r0 * random.range(0.7, 1.3);
    if (family == Family::thin) r0 = r1 = std::pow(10.0, random.range(-5, -4));
    if (family == Family::fat) r0 = r1 = random.range(0.2, 0.6);
    if (family == Family::taper) {
        r0 = random.range(0.02, 0.3);
        r1 = random.below(4) == 0 ? 0.0 : random.range(0, 0.1);
        if (random.below(2)) std::swap(r0, r1);
    }
    for (int i = 0; i < 4; ++i) c[i].w = r0 + (r1 - r0) * i / 3.0;
    if (family == Family::degenerate) {
        const uint32_t kind = random.below(5);
        const auto move = [&](int i, const glm::dvec3& p) { c[i] = glm::dvec4(p, c[i].w); };
        if (kind == 0 || kind == 2) move(1, glm::dvec3(c[0]));
        if (kind == 1 || kind == 2) move(2, glm::dvec3(c[3]));
        if (kind == 3)  // folds back on a line
            for (const int i : {1, 2})
                move(i, glm::dvec3(c[0]) + random.range(-1, 2) * glm::dvec3(c[3] - c[0]));
        if (kind == 4) {  // a cusp or loop
            move(1, glm::dvec3(c[0]) + 1.5 * glm::dvec3(c[3] - c[0]));
            move(2, glm::dvec3(c[0]) - 0.5 * glm::dvec3(c[3] - c[0]));
        }
    }
    if (family == Family::offset)
        for (glm::dvec4& p : c) p += glm::dvec4(300, -200, 100, 0);
    return to_float(c);
}

/// A ray that passes near the curve, from the given distance.
inline Ray aimed_ray(const Curve& curve, Random& random, double distance = 3) {
    const CurveD c = to_double(curve);
    const glm::dvec4 target = point_at(c, random.range(-0.02, 1.02));
    const glm::dvec3 n = random_direction(random);
    const glm::dvec3 p = glm::dvec3(target) + across(n, random) * (random.range(0, 1.4) * target.w);
    Ray ray;
    ray.origin = glm::vec3(p - n * distance);
    ray.direction = glm::vec3((p - glm::dvec3(ray.origin)) * random.range(0.5, 2.0));
    return ray;
}

/// One curve that is a whole strand.
inline Surface surface_of(const Curve& curve, Surface::Sweep sweep, Caps caps, bool straight = false) {
    Surface surface;
    surface.sweep = sweep;
    surface.caps = caps;
    surface.pieces.push_back({curve, 0, 0, 1, straight, true, true});
    return surface;
}

inline Curves curves_of(const Curve& curve) { return {{curve}, {{0, 1}}}; }

}  // namespace strandlab::oracle_cases
