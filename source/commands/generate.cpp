// strandlab generate: strands of a hair mesh or a generator, written as a model.
#include "base/error.h"
#include "base/log.h"
#include "base/sine.h"
#include "base/stopwatch.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/usage_error.h"
#include "gpu/hair_mesh/grow_on_device.h"
#include "strands/generators.h"
#include "strands/hair_mesh/grow.h"
#include "strands/hair_mesh/model.h"
#include "strands/hair_mesh/parameters.h"
#include "strands/models.h"
#include "trace/grown_model.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace strandlab {
namespace {

struct Options {
    std::string model, output, strands, points, seed, lod, device, primitive;
    std::vector<std::string> style;
    double distance = 0, fov = 45, height = 1080, factor = 0.05;
    WriteOptions write;
};

/// The model with all that the options add to it.
std::string whole_spec(const Options& options) {
    if (!is_hair_mesh_spec(options.model) && !is_generator_spec(options.model))
        fail(ExitCode::usage, "generate {}: must be FILE.hairmesh[,key=value,...] or generate:NAME,...",
             options.model);
    std::string spec = options.model;
    const auto add = [&](const char* key, const std::string& value) {
        if (!value.empty()) spec += fmt::format(",{}={}", key, value);
    };
    add("strands", options.strands);
    add("points", options.points);
    add("seed", options.seed);
    add("lod", options.lod);
    for (const std::string& pair : options.style) spec += "," + pair;
    return spec;
}

/// Adds the level of detail for a camera at options.distance, and says what it is good for.
std::string with_detail(const std::string& spec, const Options& options) {
    const HairMesh mesh = load_styled_mesh(spec);
    const double lod =
        detail_at(bundle_size(mesh), options.distance, options.fov, options.height, options.factor);
    const SinCos half = sin_cos(options.fov * (3.14159265358979323846 / 360));
    const double pixel = 2 * options.distance * half.sin / half.cos / options.height;
    const double radius = mesh.style.number("root_radius") * mesh.style.number("thickness") / lod;
    inform("lod={:.4g} at {:g} m, where a pixel is {:.3g} m wide and the radius at the root {:.3g} m", lod,
           options.distance, pixel, radius);
    if (lod < 1 && radius > 0.5 * pixel)
        warn(
            "strands that stand for {:.3g} each are thicker than a pixel: the level of detail can be seen; a "
            "larger "
            "--detail helps",
            1 / lod);
    return fmt::format("{},lod={:.9g}", spec, lod);
}

/// What the options ask a device for.
DeviceCurves grown_on(const Device& device, const std::string& spec, const Options& options) {
    if (!is_hair_mesh_spec(spec))
        fail(ExitCode::usage, "--device {}: only hair meshes grow on devices, {} does not", options.device,
             options.model);
    const HairMesh mesh = load_styled_mesh(spec);
    DeviceCurves grown = grow_on_device(device, mesh, mesh.style);
    inform("{}: {} bytes uploaded in {:.1f} ms, {} curves ({} bytes) grown in {:.1f} ms of device time",
           device.info().name, grown.table_bytes, grown.upload_ms, grown.curve_count(), grown.records.size(),
           grown.device_ms);
    return grown;
}

/// Makes an acceleration structure of curves that are on the device, and says what that took.
void build_there(const Device& device, DeviceCurves curves, const Options& options) {
    const PrimitiveChoice choice = parse_primitive(options.primitive);
    GrownModel grown = grown_model(device, std::move(curves), choice, 1.0f);
    const SceneInstance instance;
    const GpuScene scene(device, *choice.primitive, {std::move(grown.model)}, {&instance, 1}, {});
    const SceneCost& cost = scene.cost();
    inform(
        "{}: {} leaves, boxes made in {:.1f} ms, built in {:.1f} ms, compacted in {:.1f} ms of device time; "
        "{} bytes "
        "of structure and {} of records; no curve or box was copied",
        choice.label(), cost.leaf_count, grown.boxes_ms, cost.builds.build_ms, cost.builds.compaction_ms,
        cost.builds.kept_bytes, cost.record_bytes);
}

/// Strands on the host: the mesh's bytes against theirs.
void report_growth(const std::string& spec, const Curves& curves, double seconds) {
    size_t points = 0;
    for (const StrandRange& strand : curves.strands) points += strand.count + 1;
    const size_t bytes = curves.curves.size() * sizeof(Curve);
    if (is_hair_mesh_spec(spec)) {
        const size_t file = std::filesystem::file_size(parse_hair_mesh_spec(spec).file);
        inform("{}: {} bytes, {} strands, {} bytes of points, {} of curves (1 : {}), generated in {:.2f} s",
               hair_mesh_name(parse_hair_mesh_spec(spec).file), file, curves.strands.size(), 16 * points,
               bytes, bytes / file, seconds);
    } else {
        inform("{} strands, {} bytes of points, {} of curves, generated in {:.2f} s", curves.strands.size(),
               16 * points, bytes, seconds);
    }
}

int run(const Options& options) {
    std::string spec = whole_spec(options);
    if (options.distance > 0) {
        if (!is_hair_mesh_spec(spec))
            fail(ExitCode::usage, "--distance goes with hair meshes, not with {}", spec);
        spec = with_detail(spec, options);
    }
    if (options.output.empty() && !options.write.strands_path.empty())
        fail(ExitCode::usage, "--write-strands {}: goes with --output", options.write.strands_path);
    if (!options.primitive.empty() && (options.device.empty() || !options.output.empty()))
        fail(ExitCode::usage, "--primitive {}: goes with --device and without --output", options.primitive);
    const Stopwatch stopwatch;
    Curves curves;
    if (options.device.empty()) {
        ImportReport report;
        curves = load_model(spec, {}, report);
    } else {
        const Device device({.selector = options.device});
        DeviceCurves grown = grown_on(device, spec, options);
        if (!options.primitive.empty())
            build_there(device, std::move(grown), options);
        else if (!options.output.empty())
            curves = grown.download();
        if (options.output.empty()) return 0;
    }
    const double seconds = stopwatch.milliseconds() / 1000;
    if (options.output.empty()) {
        report_growth(spec, curves, seconds);
        return 0;
    }
    write_model(options.output, curves, options.write);
    inform("{}: {} strands, {} curves, generated in {:.2f} s", options.output, curves.strands.size(),
           curves.curves.size(), seconds);
    return 0;
}

std::string parameter_help() {
    std::string text = "Parameters of hair meshes (FILE.hairmesh,key=value,... or --style key=value):\n";
    for (const ParameterInfo& p : hair_mesh_parameters())
        text += fmt::format("               {}={}: {}\n", p.name, p.default_value, p.help);
    return text;
}

}  // namespace

Command generate_command() {
    const std::string examples =
        "  strandlab generate models/bob.hairmesh --strands 10000 --points 33 -o bob.hair\n"
        "  strandlab generate models/wavy.hairmesh --style wave=0.01 --style curl=0.003 -o wavy.npy "
        "--write-strands strands.npy\n"
        "  strandlab generate models/ringlets.hairmesh --distance 4 -o far.npy   # 4 m from the camera\n"
        "  strandlab generate models/ringlets.hairmesh --device llvmpipe -o same.npy\n"
        "  strandlab generate models/ringlets.hairmesh --device llvmpipe --primitive rocaps\n" +
        parameter_help();
    return {"generate", "grow the strands of a hair mesh, write them as .hair or .npy", examples,
            [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<Options>();
                app.add_option("MODEL", options->model, "FILE.hairmesh[,key=value,...] or generate:NAME,...")
                    ->required();
                app.add_option("-o,--output", options->output,
                               "file to write: .hair or .npy; none: only says sizes and times");
                app.add_option("--strands", options->strands, "number of strands at full detail");
                app.add_option("--points", options->points, "curve points of a strand");
                app.add_option("--seed", options->seed, "of the random numbers");
                app.add_option("--style", options->style, "key=value, repeatable")->allow_extra_args(false);
                app.add_option("--lod", options->lod,
                               "level of detail, up to 1: share of strands and points");
                app.add_option("--distance", options->distance,
                               "level of detail for a camera that far away, m, and the three options below")
                    ->check(CLI::Range(1e-3, 1e6))
                    ->excludes("--lod");
                app.add_option("--fov", options->fov, "vertical field of view, degrees")
                    ->check(CLI::Range(0.01, 179.0))
                    ->capture_default_str();
                app.add_option("--height", options->height, "of the picture, pixels")
                    ->check(CLI::Range(1.0, 1e6))
                    ->capture_default_str();
                app.add_option("--detail", options->factor,
                               "share of the strands that a bundle keeps for every pixel of its size")
                    ->check(CLI::Range(1e-6, 1e6))
                    ->capture_default_str();
                app.add_option("--device", options->device,
                               "grow the strands on this device (as `info` lists them) instead of the host: "
                               "the same strands");
                app.add_option(
                    "--primitive", options->primitive,
                    "with --device: build this primitive's acceleration structure there, without a copy "
                    "of the curves on the host");
                add_write_options(app, options->write);
                return [options] { return run(*options); };
            }};
}

}  // namespace strandlab
