#include "strands/hair_mesh/model.h"

#include "base/log.h"
#include "strands/hair_mesh/grow.h"
#include "strands/hair_mesh/parameters.h"

namespace strandlab {
namespace {

constexpr std::string_view extension = ".hairmesh";

/// Where the file's name ends; npos when the model is no hair mesh.
size_t end_of_file(std::string_view model) {
    for (size_t at = model.find(extension); at != std::string_view::npos;
         at = model.find(extension, at + 1)) {
        const size_t end = at + extension.size();
        if (end == model.size() || model[end] == ',') return end;
    }
    return std::string_view::npos;
}

}  // namespace

bool is_hair_mesh_spec(std::string_view model) {
    return model.substr(0, 9) != "generate:" && end_of_file(model) != std::string_view::npos;
}

HairMeshSpec parse_hair_mesh_spec(std::string_view model) {
    const size_t end = end_of_file(model);
    return {std::string(model.substr(0, end)), std::string(end < model.size() ? model.substr(end + 1) : "")};
}

std::string hair_mesh_name(std::string_view model) {
    const HairMeshSpec spec = parse_hair_mesh_spec(model);
    const size_t begin = spec.file.rfind('/') + 1;  // npos + 1 is 0
    const std::string name = spec.file.substr(begin, spec.file.size() - extension.size() - begin);
    return spec.parameters.empty() ? name : name + "," + spec.parameters;
}

HairMesh load_styled_mesh(std::string_view model) {
    const HairMeshSpec spec = parse_hair_mesh_spec(model);
    HairMesh mesh = read_hair_mesh(ByteSource::from_file(spec.file));
    mesh.style.set_all(spec.file, hair_mesh_parameters(), spec.parameters);
    return mesh;
}

Curves load_hair_mesh_model(std::string_view model) {
    const HairMesh mesh = load_styled_mesh(model);
    if (const auto line = divergence(mesh, make_columns(mesh)))
        warn("{}: {}", parse_hair_mesh_spec(model).file, *line);
    return grow_hair_mesh(mesh, mesh.style);
}

}  // namespace strandlab
