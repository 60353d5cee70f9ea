// Strands of a hair mesh as curves.
#pragma once

#include "strands/curves.h"
#include "strands/hair_mesh/columns.h"
#include "strands/hair_mesh/hair_mesh.h"
#include "strands/hair_mesh/level_of_detail.h"

#include <cstdint>
#include <vector>

namespace strandlab {

/// Curves in some precision; of float ones, Curves.
template <class Real>
struct GrownStrands {
    std::vector<std::array<glm::vec<4, Real>, 4>> curves;
    std::vector<StrandRange> strands;
};

/// Grows the strands that the parameters (of hair_mesh_parameters()) ask for, bundle after bundle. Strand
/// `index` of a face depends on seed, face and index alone, to the last bit (float): not on the number of
/// strands, the level of detail, the machine or its threads.
///
/// A strand is the blend of its bundle's columns; styled, it is sampled evenly in its parameter, and the
/// uniform Catmull-Rom curve through the styled points, with parabolas as end pieces, is the strand: against
/// the ideal styled curve it is off by at most 0.016 h^3 |f'''|, h being a piece. points=0 gives the unstyled
/// blend exactly, one cubic a layer. Radii run linearly from root to tip.
template <class Real>
GrownStrands<Real> grow_hair_mesh(const HairMesh& mesh, const Parameters& parameters);

/// In float.
Curves grow_hair_mesh(const HairMesh& mesh, const Parameters& parameters);

}  // namespace strandlab
