// A few strands that show what goes wrong, and rays aimed at them: shared by the conformance tests.
#pragma once

#include "base/random.h"
#include "scene/rays.h"
#include "strands/bezier.h"
#include "strands/curves.h"

#include <cmath>
#include <cstring>
#include <vector>

namespace strandlab {

/// Strands of three curves each: straight, gently bent, curled, tapered to a point.
inline Curves conformance_curves(uint32_t strand_count = 24) {
    Curves curves;
    for (uint32_t s = 0; s < strand_count; ++s) {
        Random random(11, 0, s);
        const double bend = s % 4 == 0 ? 0.0 : random.range(0.1, 1.5);
        const double thick = random.range(0.002, 0.02),
                     tip = s % 4 == 3 ? 0.0 : thick * random.range(0.3, 1.0);
        const glm::dvec3 root(random.signed_unit(), random.signed_unit(), random.signed_unit());
        // Joints on an arc, tangents from neighbours.
        std::vector<glm::dvec3> joints;
        for (int k = -1; k <= 4; ++k) {
            const double angle = bend * k;
            joints.push_back(root + 0.3 * (bend > 0 ? glm::dvec3(std::sin(angle) / bend,
                                                                 (1 - std::cos(angle)) / bend, 0.1 * k)
                                                    : glm::dvec3(k, 0.2 * k, -0.4 * k)));
        }
        curves.strands.push_back({static_cast<uint32_t>(curves.curves.size()), 3});
        for (int c = 0; c < 3; ++c) {
            const auto radius = [&](double at) { return float(thick + (tip - thick) * at / 3); };
            const glm::dvec3 p0 = joints[c + 1], p3 = joints[c + 2];
            const glm::dvec3 d0 = (p3 - joints[c]) / 6.0, d3 = (joints[c + 3] - p0) / 6.0;
            curves.curves.push_back({glm::vec4(glm::vec3(p0), radius(c)),
                                     glm::vec4(glm::vec3(p0 + d0), radius(c + 1 / 3.0)),
                                     glm::vec4(glm::vec3(p3 - d3), radius(c + 2 / 3.0)),
                                     glm::vec4(glm::vec3(p3), radius(c + 1))});
        }
    }
    return curves;
}

/// Rays from outside at points around the centre lines; directions not of unit length.
inline std::vector<Ray> conformance_rays(const Curves& curves, uint32_t count = 3000) {
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < count; ++i) {
        Random random(12, 0, i);
        const Curve& curve = curves.curves[random.below(static_cast<uint32_t>(curves.curves.size()))];
        const glm::dvec4 at = point_at(to_double(curve), random.uniform());
        const glm::dvec3 aside(random.signed_unit(), random.signed_unit(), random.signed_unit());
        const glm::dvec3 target = glm::dvec3(at) + 0.9 * at.w * aside;
        const glm::dvec3 direction =
            glm::dvec3(random.signed_unit(), random.signed_unit(), random.signed_unit()) + 1e-3;
        rays.push_back({glm::vec3(target - 4.0 * direction / glm::length(direction)), 0.0f,
                        glm::vec3(direction), 1e30f});
    }
    return rays;
}

}  // namespace strandlab
