// What the documents say of the bundled hair meshes is what the files hold and what was measured.
#include "unit/hair_mesh_models.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace strandlab {
namespace {

using testing_tools::bundled_mesh;
using testing_tools::hair_mesh_names;

std::string text_of(const std::string& path) {
    std::ifstream file(STRANDLAB_MODELS "/../" + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::string with_commas(uintmax_t number) {
    std::string text = std::to_string(number);
    for (size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
    return text;
}

TEST(HairMeshDocuments, TheModelsTableIsTrue) {
    const std::string table = text_of("models/README.md");
    for (const char* name : hair_mesh_names) {
        const HairMesh mesh = bundled_mesh(name);
        const auto bytes = std::filesystem::file_size(fmt::format(STRANDLAB_MODELS "/{}.hairmesh", name));
        const std::string row = fmt::format(
            "| `{}.hairmesh` | {} | {} | {} {} | {} |", name, with_commas(bytes), mesh.vertex_count,
            mesh.faces.size(), mesh.faces[0].is_triangle() ? "triangles" : "quads", mesh.layer_count);
        EXPECT_NE(table.find(row), std::string::npos) << "models/README.md lacks: " << row;
    }
    const auto head = std::filesystem::file_size(STRANDLAB_MODELS "/head.obj");
    EXPECT_NE(table.find("| `head.obj` | " + with_commas(head) + " |"), std::string::npos) << head;
}

/// Sizes in the results follow from the files; the README quotes the measured rows word for word.
TEST(HairMeshDocuments, QuotedFiguresComeFromTheResults) {
    const std::vector<std::string> results = lines_of(text_of("tests/results/hair_mesh_models.txt"));
    const std::string readme = text_of("source/strands/hair_mesh/README.md");
    size_t rows = 0;
    for (const std::string& line : results) {
        if (line.empty() || line[0] != '|') continue;
        EXPECT_NE(readme.find(line + "\n"), std::string::npos) << "the README lacks: " << line;
        for (const char* name : hair_mesh_names) {
            if (line.rfind(fmt::format("| {} |", name), 0) != 0) continue;
            ++rows;
            const auto bytes = std::filesystem::file_size(fmt::format(STRANDLAB_MODELS "/{}.hairmesh", name));
            const HairMesh mesh = bundled_mesh(name);
            const uintmax_t strands = 100'000, points = mesh.style.integer("points");
            const uintmax_t as_points = strands * points * 16, as_curves = strands * (points - 1) * 64;
            const std::string sizes =
                fmt::format("| {} | {} | {} | {} | {} | 1 : {} |", name, with_commas(bytes), points,
                            with_commas(as_points), with_commas(as_curves), with_commas(as_curves / bytes));
            EXPECT_EQ(line.substr(0, sizes.size()), sizes);
        }
    }
    EXPECT_EQ(rows, hair_mesh_names.size());
}

}  // namespace
}  // namespace strandlab
