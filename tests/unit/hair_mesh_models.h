// The bundled hair meshes, for tests.
#pragma once

#include "strands/hair_mesh/grow.h"
#include "strands/hair_mesh/parameters.h"

#include <array>
#include <string>

namespace strandlab::testing_tools {

inline constexpr std::array<const char*, 7> hair_mesh_names{"bob",      "wavy",  "ringlets", "afro",
                                                            "ponytail", "braid", "fur"};

inline HairMesh bundled_mesh(const std::string& name) {
    return read_hair_mesh(ByteSource::from_file(STRANDLAB_MODELS "/" + name + ".hairmesh"));
}

/// The mesh's own style, changed.
inline Parameters style_with(const HairMesh& mesh, const std::string& changes) {
    Parameters style = mesh.style;
    style.set_all(mesh.name, hair_mesh_parameters(), changes);
    return style;
}

/// Settings without any styling.
inline Parameters plain_style(const std::string& changes) {
    Parameters style(hair_mesh_parameters());
    style.set_all("plain", hair_mesh_parameters(), changes);
    return style;
}

inline constexpr double hair_radius = 35e-6;  // m: the unit in which errors are told

}  // namespace strandlab::testing_tools
