// A hair mesh: a coarse mesh on the scalp that is extruded along the hair, layer by layer (Yuksel, Schaefer
// and Keyser 2009, "Hair Meshes"). A face with its extrusions is a bundle; strands grow inside the bundles.
#pragma once

#include "base/byte_source.h"
#include "base/parameters.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace strandlab {

/// A root face, counter-clockwise seen from outside; vertex[3] means nothing for a triangle.
struct HairMeshFace {
    std::array<uint32_t, 4> vertex{};
    uint32_t corners = 4;  // 3 or 4

    bool is_triangle() const { return corners == 3; }
};

/// How the directions u and v of the styling run up a column.
enum class FrameRule {
    root,   // those of the root layer, carried along the column without twist
    layer,  // those of every layer's own surface: for layers that are cross-sections (braids)
};

/// The mesh. Its numbers are those of the file, in units of `unit` metres; the style's are in metres and per
/// metre. Invariants (check_hair_mesh): what the checks say.
struct HairMesh {
    std::vector<std::string> comments;  // the lines after the first one that begin with '#', as they are
    std::string name;
    std::string unit_name = "mm";
    FrameRule frames = FrameRule::root;
    Parameters style;  // of hair_mesh_parameters()
    std::vector<HairMeshFace> faces;
    uint32_t vertex_count = 0;
    uint32_t layer_count = 0;           // extrusions; the columns have one more point
    std::vector<glm::dvec2> uv;         // of every vertex
    std::vector<glm::dvec3> positions;  // layer after layer, root first
    /// Distance from the root along the hair, as positions. Empty: the length of the column's polyline.
    std::vector<double> w;

    HairMesh();
    double unit() const;  // metres
    size_t index(uint32_t layer, uint32_t vertex) const { return size_t(layer) * vertex_count + vertex; }
};

/// Reads the text form and checks it (check_hair_mesh). Throws Error (bad_input) naming file, line, value and
/// reason. Nothing is allocated that the file's length does not warrant.
HairMesh read_hair_mesh(const ByteSource& source);

/// Writes the text form, whole or not at all. Reading it and writing it again gives the same bytes.
void write_hair_mesh(const std::string& path, const HairMesh& mesh);

/// The text that write_hair_mesh writes.
std::string to_text(const HairMesh& mesh);

/// Where the parts of a mesh stand in its file: for messages.
struct HairMeshLines {
    std::string file;
    std::vector<size_t> faces, uv, positions;  // line of each; empty: the mesh is from no file

    /// "bob.hairmesh: line 12", or the file alone.
    std::string at(const std::vector<size_t>& lines, size_t index) const;
};

/// Throws Error (bad_input) unless: every vertex is in a face; no face uses a vertex twice, is degenerate,
/// winds the wrong way in uv, or folds over itself or over its neighbour; neighbours run along a shared edge
/// in opposite directions; the layers of a column are 1e-6 m apart at least; w increases along every column.
void check_hair_mesh(const HairMesh& mesh, const HairMeshLines& lines);

}  // namespace strandlab
