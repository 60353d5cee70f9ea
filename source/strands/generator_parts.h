// What the generators share: their parameters, the loop over strands, frames and directions.
#pragma once

#include "base/parallel.h"
#include "base/parameters.h"
#include "base/random.h"
#include "strands/generators.h"
#include "strands/strands.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace strandlab {

constexpr double tau = 6.28318530717958647693;

/// The generators, one per source file.
Generator patch_generator(std::string name);  // straight, wavy, helix
Generator head_generator();
Generator fur_generator();
Generator cases_generator();

/// strands, points, seed, length, length_variation, root_radius, tip_radius with these defaults.
std::vector<ParameterInfo> common_parameters(std::string strands, std::string points, std::string length,
                                             std::string length_variation);

/// A unit vector orthogonal to unit vector n.
glm::dvec3 any_orthogonal(const glm::dvec3& n);

/// A uniform direction.
glm::dvec3 random_direction(Random& random);

/// Fills all strands in parallel: make_filler() gives each block of strands one callable (which may own
/// scratch memory) that is called as fill(strand, points) with points of one strand to set; radii are set
/// here, linear from root to tip. Then makes centripetal curves.
template <class MakeFiller>
Curves grow_strands(const Parameters& parameters, MakeFiller&& make_filler) {
    const size_t count = parameters.integer("strands"), n = parameters.integer("points");
    Strands strands;
    strands.points.resize(count * n);
    strands.first_point.resize(count + 1);
    for (size_t s = 0; s <= count; ++s) strands.first_point[s] = static_cast<uint32_t>(s * n);
    const double root = parameters.number("root_radius"), tip = parameters.number("tip_radius");
    constexpr size_t block = 64;
    parallel_for((count + block - 1) / block, [&](size_t b) {
        auto fill = make_filler();
        for (size_t s = b * block, end = std::min(count, s + block); s < end; ++s) {
            const std::span<glm::vec4> points(&strands.points[s * n], n);
            fill(s, points);
            for (size_t i = 0; i < n; ++i) {
                const double u = double(i) / double(n - 1);
                points[i].w = static_cast<float>((1 - u) * root + u * tip);
            }
        }
    });
    ImportReport report;
    return make_curves(strands, {}, report);
}

}  // namespace strandlab
