// Hair meshes where a model is named: "FILE.hairmesh" or "FILE.hairmesh,key=value,...".
#pragma once

#include "strands/curves.h"
#include "strands/hair_mesh/hair_mesh.h"

#include <string>
#include <string_view>

namespace strandlab {

/// Whether a model is a hair mesh, with or without parameters.
bool is_hair_mesh_spec(std::string_view model);

/// FILE of such a model, and its parameters.
struct HairMeshSpec {
    std::string file, parameters;
};
HairMeshSpec parse_hair_mesh_spec(std::string_view model);

/// What results call the model: the file's name without folder and extension, and the parameters.
std::string hair_mesh_name(std::string_view model);

/// Loads the mesh; its style is the file's, changed by the parameters.
HairMesh load_styled_mesh(std::string_view model);

/// Loads the mesh and grows its strands: the file's style, changed by the parameters. Columns that diverge
/// are warned of. Throws Error (bad_input for the file, usage for the parameters).
Curves load_hair_mesh_model(std::string_view model);

}  // namespace strandlab
