#include "strands/hair_mesh/hair_mesh.h"

#include "strands/hair_mesh/parameters.h"
#include "strands/hair_mesh/units.h"

#include <fmt/core.h>

namespace strandlab {

HairMesh::HairMesh() : style(hair_mesh_parameters()) {}

double HairMesh::unit() const { return unit_named(unit_name).value(); }

std::string HairMeshLines::at(const std::vector<size_t>& lines, size_t item) const {
    return item < lines.size() ? fmt::format("{}: line {}", file, lines[item]) : file;
}

}  // namespace strandlab
