#include "commands/bundled_models.h"

#include "base/error.h"
#include "strands/hair_mesh/hair_mesh.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders() {
    std::vector<fs::path> all;
    if (const char* folder = std::getenv("STRANDLAB_MODELS")) all.emplace_back(folder);
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (!error) {
        all.push_back(program.parent_path() / "models");                          // BUILD/strandlab
        all.push_back(program.parent_path() / "share" / "strandlab" / "models");  // PREFIX/bin/strandlab
    }
    all.emplace_back("models");
    return all;
}

/// About as many curves of every hair mesh; with half its points, which are plenty, and thick enough for a
/// few hundred strands to cover the head.
constexpr uint32_t curves_per_model = 8000;
constexpr const char* thickness = "12";

/// A hair mesh as a model for a first look.
std::string small_model(const std::string& file) {
    const HairMesh mesh = read_hair_mesh(ByteSource::from_file(file));
    const uint32_t pieces = std::max(2u, mesh.style.integer("points")) / 2;
    return fmt::format("{},strands={},points={},thickness={}", file, std::max(1u, curves_per_model / pieces),
                       pieces + 1, thickness);
}

std::vector<std::string> files_in(const fs::path& folder, const char* extension) {
    std::vector<std::string> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == extension) files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

std::vector<std::string> bundled_models() {
    for (const fs::path& folder : folders()) {
        std::vector<std::string> models = files_in(folder, ".hairmesh");
        for (std::string& model : models) model = small_model(model);
        if (models.empty()) models = files_in(folder, ".hair");
        if (!models.empty()) return models;
    }
    fail(ExitCode::bad_input,
         "no bundled models were found; name a MODEL, or set STRANDLAB_MODELS to their folder");
}

}  // namespace strandlab
