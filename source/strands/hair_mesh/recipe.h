// What all strands that are grown together share, on the host and on devices.
#pragma once

#include "strands/hair_mesh/bundle.h"
#include "strands/hair_mesh/level_of_detail.h"

#include <vector>

namespace strandlab {

/// Parameters and columns, ready for growing. The mesh must outlive it.
template <class Real>
struct GrowthRecipe {
    const HairMesh& mesh;
    ColumnNumbers<Real> columns;
    typename kernels::HairStrandKernel<Real>::StrandStyle style;
    uint32_t seed, clumps;
    PointLevel level;
    bool styled;      // else strands are the blends of their columns, a cubic a layer
    glm::vec2 radii;  // root, tip; at thickness 1
    std::vector<BundleCount> counts;

    uint32_t curves_per_strand() const { return styled ? level.pieces : columns.layers; }
    uint64_t strand_count() const;

    /// Whether strands close in on the middle of their clump or share something with it: their clump matters.
    bool has_clumps() const { return style.clump > 0 || style.curl > 0 || style.wave > 0 || style.kink > 0; }
};

/// Throws Error (usage) for points=1 and where there would be 2^32 - 1 curves or more.
template <class Real>
GrowthRecipe<Real> make_recipe(const HairMesh& mesh, const Parameters& parameters);

}  // namespace strandlab
