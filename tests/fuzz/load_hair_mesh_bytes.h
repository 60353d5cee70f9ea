// Runs bytes through the reader of hair meshes and grows a few strands, as the program would.
#pragma once

#include "fuzz/load_bytes.h"
#include "strands/hair_mesh/grow.h"
#include "strands/hair_mesh/parameters.h"

namespace strandlab {

/// Whether the mesh is accepted.
inline bool load_hair_mesh_bytes(std::span<const std::byte> bytes) {
    return accepts_input([&] {
        HairMesh mesh = read_hair_mesh(ByteSource::from_memory("input", bytes));
        const std::string text = to_text(mesh);
        const ByteSource written =
            ByteSource::from_memory("input", std::as_bytes(std::span(text.data(), text.size())));
        if (to_text(read_hair_mesh(written)) != text)
            throw std::logic_error("writing and reading again changes the mesh");
        mesh.style.set_all("input", hair_mesh_parameters(), "strands=40");
        if (mesh.style.integer("points") == 1) return;
        require_invariants(grow_hair_mesh(mesh, mesh.style));
    });
}

}  // namespace strandlab
