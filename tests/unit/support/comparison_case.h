// A few rays with results to compare.
#pragma once

#include "measure/comparison.h"

#include <vector>

namespace strandlab::testing {

inline constexpr float radius = 0.01f;

/// A straight curve along x from x to x + 1 at height y.
inline Curve line(float x, float y) {
    Curve curve;
    for (int i = 0; i < 4; ++i) curve[i] = glm::vec4(x + static_cast<float>(i) / 3, y, 0, radius);
    return curve;
}

/// Strand 0: curves 0 and 1 end to end; strand 1: curve 2 above them.
inline Curves two_strands() {
    Curves curves;
    curves.curves = {line(0, 0), line(1, 0), line(0, 1)};
    curves.strands = {{0, 2}, {2, 1}};
    return curves;
}

/// Rays downwards onto the curves from height 1, with results that agree until a test changes them.
struct Case {
    Curves curves = two_strands();
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<ReferenceHit> reference;
    std::vector<uint8_t> decisive;
    std::vector<glm::vec3> normals;

    size_t add(bool hits_something = true) {
        Ray ray;
        ray.origin = {0.5f, 0, 1};
        ray.direction = {0, 0, -1};
        rays.push_back(ray);
        Hit hit;
        ReferenceHit expected;
        if (hits_something) {
            hit = {1 - radius, 0.5f, 0, 0};
            expected.t = static_cast<double>(1 - radius);
            expected.u = 0.5;
            expected.normal = {0, 0, 1};
            expected.radius = static_cast<double>(radius);
            expected.curve = 0;
        }
        hits.push_back(hit);
        reference.push_back(expected);
        decisive.push_back(1);
        normals.push_back({0, 0, 1});
        return rays.size() - 1;
    }

    ComparisonInput input() const {
        ComparisonInput in;
        in.rays = rays;
        in.hits = hits;
        in.reference = reference;
        in.decisive = decisive;
        in.normals = normals;
        in.curves = &curves;
        return in;
    }
    Comparison result() const { return compare(input()); }
    Outcome outcome() const {
        const ComparisonInput in = input();
        return RayErrors(in).of(rays.size() - 1).outcome;
    }
    float error(Measure measure) const {
        const ComparisonInput in = input();
        return RayErrors(in).of(rays.size() - 1).measures[static_cast<size_t>(measure)];
    }
};

}  // namespace strandlab::testing
