#include "commands/bundled_models.h"

#include "base/error.h"

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

}  // namespace

std::vector<std::string> bundled_models() {
    std::vector<std::string> models;
    for (const fs::path& folder : folders()) {
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
            if (entry.path().extension() == ".hair") models.push_back(entry.path().string());
        if (!models.empty()) break;
    }
    if (models.empty())
        fail(ExitCode::bad_input,
             "no bundled models were found; name a MODEL, or set STRANDLAB_MODELS to their folder");
    std::sort(models.begin(), models.end());
    return models;
}

}  // namespace strandlab
