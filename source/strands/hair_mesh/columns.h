// The columns of a hair mesh as exact cubics, with directions for the styling: all that its strands need.
#pragma once

#include "strands/hair_mesh/hair_mesh.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace strandlab {

/// Every column as a centripetal Catmull-Rom curve (Yuksel, Schaefer and Keyser 2011) whose end pieces are
/// parabolas, in metres. The knot intervals belong to the layers, not to the columns (mean of sqrt(chord)
/// over all vertices), so that a blend of columns is again the Catmull-Rom curve of the blended points, with
/// no kink at the layers.
struct HairMeshColumns {
    uint32_t layers = 0, vertices = 0;
    std::vector<double> knots;         // interval of every layer
    std::vector<glm::dvec3> controls;  // 3 layers + 1 Bezier control points of every column
    std::vector<glm::dvec3> u, v;      // layers + 1 directions of every column
    std::vector<double> w;             // layers + 1 distances from the root of every column

    size_t control_count() const { return size_t(3) * layers + 1; }
};

HairMeshColumns make_columns(const HairMesh& mesh);

/// The Bezier form of the Catmull-Rom curve through points (knots.size() + 1 of them) on those knot
/// intervals, end pieces parabolas; one interval gives the line. out has 3 knots.size() + 1 places.
void catmull_rom_column(const std::vector<double>& knots, const glm::dvec3* points, glm::dvec3* out);

/// One line where the styling of some bundles fades because the directions of their columns diverge: where
/// the blend of u or of v at the centre of a face is shorter than a half.
std::optional<std::string> divergence(const HairMesh& mesh, const HairMeshColumns& columns);

}  // namespace strandlab
