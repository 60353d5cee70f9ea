// The simplest hair.
#pragma once

#include "strands/curves.h"

#include <cstdint>

namespace strandlab {

/// Straight strands of one curve along x, at y = 0, 1, 2..., of radius 0.1.
inline Curves parallel_strands(uint32_t count) {
    Curves curves;
    for (uint32_t i = 0; i < count; ++i) {
        Curve curve;
        for (int k = 0; k < 4; ++k) curve[k] = glm::vec4(float(k), float(i), 0.0f, 0.1f);
        curves.curves.push_back(curve);
        curves.strands.push_back({i, 1});
    }
    return curves;
}

}  // namespace strandlab
