#include "report/load_images_module.h"

#include "base/error.h"

#include <dlfcn.h>
#include <filesystem>
#include <system_error>
#include <vector>

namespace strandlab {
namespace {

#ifdef STRANDLAB_IMAGES

namespace fs = std::filesystem;

constexpr const char* file_name = "strandlab_images.so";

/// Where the module may be, in order.
std::vector<fs::path> places() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return {};
    const fs::path folder = program.parent_path();
    return {folder / file_name, folder.parent_path() / file_name,
            folder.parent_path() / "lib" / "strandlab" / file_name};
}

fs::path find_module() {
    std::error_code ignored;
    for (const fs::path& place : places())
        if (fs::is_regular_file(place, ignored)) return place;
    return {};
}

const ImagesModule& open_module(const std::string& image) {
    const fs::path module = find_module();
    if (module.empty())
        fail(ExitCode::usage,
             "{}: images need {} next to the program or in ../lib/strandlab; build or install it", image,
             file_name);
    // Never closed: OpenImageIO keeps threads and statics of its own.
    void* handle = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) fail(ExitCode::usage, "{}: images are not available: {}", image, ::dlerror());
    const auto entry = reinterpret_cast<ImagesModuleEntry>(::dlsym(handle, images_module_symbol));
    const ImagesModule* functions = entry ? entry() : nullptr;
    if (!functions || functions->version != images_module_version)
        fail(ExitCode::usage, "{}: {} is of another version of strandlab; build it again", image,
             module.string());
    return *functions;
}

#endif

}  // namespace

#ifdef STRANDLAB_IMAGES

bool has_images() { return !find_module().empty(); }

const ImagesModule& load_images_module(const std::string& path) {
    static const ImagesModule& module = open_module(path);
    return module;
}

#else

bool has_images() { return false; }

const ImagesModule& load_images_module(const std::string& path) {
    fail(ExitCode::usage,
         "{}: this build has no images; configure it with -DSTRANDLAB_IMAGES=ON (needs OpenImageIO)", path);
}

#endif

}  // namespace strandlab
