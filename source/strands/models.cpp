#include "strands/models.h"

#include "base/error.h"
#include "base/text.h"
#include "strands/generators.h"
#include "strands/hair_mesh/model.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace strandlab {
namespace {

/// A reader of polylines as a reader of curves.
template <Strands (*load)(const ByteSource&, ImportReport&)>
Curves load_polylines(const ModelInput& input) {
    const Strands strands = load(input.source, input.report);
    try {
        return make_curves(strands, input.options, input.report);
    } catch (const Error& error) {
        throw Error(error.code, input.source.name() + ": " + error.what());
    }
}

Curves load_curves(const ModelInput& input) {
    Curves curves = load_npy_curves(input.source, input.strands, input.report);
    try {
        apply_options(curves, input.options, input.report);
    } catch (const Error& error) {
        throw Error(error.code, input.source.name() + ": " + error.what());
    }
    return curves;
}

std::string extension_of(const std::string& path) {
    const size_t name = path.rfind('/') + 1;  // npos + 1 is 0
    const size_t dot = path.find_last_of('.');
    if (dot == std::string::npos || dot < name) return "";
    std::string extension = path.substr(dot);
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

const ModelFormat& format_of(const std::string& path, bool to_write) {
    const std::string extension = extension_of(path);
    std::vector<std::string> known;
    for (const ModelFormat& format : model_formats()) {
        if (to_write && !format.write) continue;
        if (format.extension == extension) return format;
        known.push_back(format.extension);
    }
    fail(ExitCode::bad_input, "{}: extension '{}' cannot be {}; it must be {}{}", path, extension,
         to_write ? "written" : "read", list_of(known),
         to_write ? "" : ", FILE.hairmesh[,key=value,...] or the model generate:NAME,...");
}

}  // namespace

const std::vector<ModelFormat>& model_formats() {
    static const std::vector<ModelFormat> formats{
        {".data", "USC hair salon: polylines", load_polylines<load_data>, nullptr},
        {".hair", "HAIR (Cem Yuksel): polylines, diameters", load_polylines<load_hair>, write_hair},
        {".npy", "NumPy float32 [N,4,4]: Bezier curves with radii", load_curves, write_npy_curves, true},
        {".tfx", "TressFX 4: polylines", load_polylines<load_tfx>, nullptr},
    };
    return formats;
}

std::string model_name(const std::string& path) {
    if (is_generator_spec(path)) return path.substr(path.find(':') + 1);
    return is_hair_mesh_spec(path) ? hair_mesh_name(path) : std::filesystem::path(path).stem().string();
}

Curves load_model(const std::string& path, const CurveOptions& options, ImportReport& report,
                  const std::string& strands_path) {
    const bool is_mesh = is_hair_mesh_spec(path), generated = is_mesh || is_generator_spec(path);
    const ModelFormat* format = generated ? nullptr : &format_of(path, false);
    if (!strands_path.empty() && !(format && format->takes_strands))
        fail(ExitCode::usage, "{}: a strands file ({}) goes with .npy curves only", path, strands_path);
    if (generated) {
        Curves curves = is_mesh ? load_hair_mesh_model(path) : generate(path);
        apply_options(curves, options, report);
        return curves;
    }
    const ByteSource source = ByteSource::from_file(path);
    std::optional<ByteSource> strands;
    if (!strands_path.empty()) strands = ByteSource::from_file(strands_path);
    return format->load({source, strands ? &*strands : nullptr, options, report});
}

void check_output(const std::string& path, const WriteOptions& options) {
    const ModelFormat& format = format_of(path, true);
    if (!options.strands_path.empty() && !format.takes_strands)
        fail(ExitCode::usage, "{}: a strands file ({}) goes with .npy curves only", path,
             options.strands_path);
}

void write_model(const std::string& path, const Curves& curves, const WriteOptions& options) {
    check_output(path, options);
    format_of(path, true).write(path, curves, options);
}

}  // namespace strandlab
