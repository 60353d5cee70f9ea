#include "base/file.h"
#include "strands/hair_mesh/hair_mesh.h"
#include "strands/hair_mesh/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace strandlab {
namespace {

constexpr size_t line_width = 110;

/// "style key=value ..." of what differs from the defaults, in lines that fit a screen.
std::string style_text(const Parameters& style) {
    std::string text, line;
    const std::string all = style.to_string(hair_mesh_parameters());
    for (size_t at = 0; at < all.size();) {
        const size_t comma = std::min(all.find(',', at), all.size());
        const std::string pair = all.substr(at, comma - at);
        if (!line.empty() && line.size() + 1 + pair.size() > line_width) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "style " : " ") + pair;
        at = comma + 1;
    }
    return line.empty() ? text : text + line + "\n";
}

}  // namespace

std::string to_text(const HairMesh& mesh) {
    std::string text = "strandlab hairmesh 1\n";
    for (const std::string& comment : mesh.comments) text += comment + "\n";
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "name {}\nunit {}\nvertices {}\nlayers {}\nfaces {}\n", mesh.name, mesh.unit_name,
                   mesh.vertex_count, mesh.layer_count, mesh.faces.size());
    if (mesh.frames == FrameRule::layer) text += "frames layer\n";
    text += style_text(mesh.style) + "uv\n";
    for (const glm::dvec2& p : mesh.uv) fmt::format_to(out, "{} {}\n", p.x, p.y);
    text += "faces\n";
    for (const HairMeshFace& face : mesh.faces) {
        text += face.is_triangle() ? "t" : "q";
        for (uint32_t k = 0; k < face.corners; ++k) fmt::format_to(out, " {}", face.vertex[k]);
        text += "\n";
    }
    for (uint32_t layer = 0; layer <= mesh.layer_count; ++layer) {
        fmt::format_to(out, "layer {}\n", layer);
        for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
            const glm::dvec3& p = mesh.positions[mesh.index(layer, i)];
            fmt::format_to(out, "{} {} {}", p.x, p.y, p.z);
            if (!mesh.w.empty()) fmt::format_to(out, " {}", mesh.w[mesh.index(layer, i)]);
            text += "\n";
        }
    }
    return text;
}

void write_hair_mesh(const std::string& path, const HairMesh& mesh) { write_file(path, to_text(mesh)); }

}  // namespace strandlab
