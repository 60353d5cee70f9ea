// The common ground truth: cubic Bezier curves with a radius at each control point, grouped in strands.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace strandlab {

/// One cubic Bezier curve. Each control point is (x, y, z, radius) in scene units (metres unless the
/// model says otherwise); the radius along the curve is the cubic with these Bezier coefficients.
using Curve = std::array<glm::vec4, 4>;

/// The curves [first, first + count) of one strand, root first; consecutive curves share an end point.
struct StrandRange {
    uint32_t first = 0;
    uint32_t count = 0;
};

/// Curves of one model. Invariants (established by make_curves and the loaders): all numbers finite,
/// radii >= 0, the strands cover the curves exactly once and in order.
struct Curves {
    std::vector<Curve> curves;
    std::vector<StrandRange> strands;

    /// Strand that holds a curve (binary search over the strands).
    uint32_t strand_of(uint32_t curve) const;
    /// True when the curve begins (ends) its strand.
    bool begins_strand(uint32_t curve) const;
    bool ends_strand(uint32_t curve) const;
};

/// A copy of the curves with all radii multiplied by scale.
Curves with_scaled_radii(const Curves& curves, float scale);

/// Content hash of the curves and the strands.
uint64_t hash(const Curves& curves);

}  // namespace strandlab
