// strandlab lod: level of detail against distance, on every primitive: error, bytes, time.
#include "commands/lod.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "commands/command.h"
#include "commands/ray_arguments.h"
#include "commands/usage_error.h"
#include "measure/bench_case.h"
#include "measure/lod_sweep.h"
#include "measure/statistics.h"
#include "report/lod_chart.h"
#include "report/table.h"
#include "report/text_format.h"
#include "strands/hair_mesh/model.h"
#include "trace/ray_sets.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace strandlab {
namespace {

/// One level of detail on one primitive.
struct Measured {
    size_t strands = 0, curves = 0;
    uint64_t bytes = 0;
    double build_ms = 0, trace_ms = 0;
    Hits primary, shadow;
};

Measured measure(const TraceDevice& device, const Scene& scene, const PrimitiveChoice& choice,
                 const Rays& primary, const Rays& shadow, uint32_t repeat) {
    const Curves& curves = scene.models.front();
    CaseInput input{device, scene, curves, repeat, 0, {}};
    input.options.ray_extent = object_extent(scene, std::max(extent_of(primary), extent_of(shadow)));
    const PreparedCase prepared = prepare_case(input, choice);
    TraceResult result = prepared.traced->trace(primary, {.samples = repeat});
    Measured measured;
    measured.strands = curves.strands.size();
    measured.curves = curves.curves.size();
    const SceneCost& cost = prepared.traced->cost();
    measured.bytes = cost.builds.kept_bytes + cost.record_bytes;
    measured.build_ms =
        prepared.geometry_ms + cost.order_ms + cost.builds.build_ms + cost.builds.compaction_ms;
    std::sort(result.milliseconds.begin(), result.milliseconds.end());
    measured.trace_ms = result.milliseconds[result.milliseconds.size() / 2];
    measured.primary = std::move(result.hits);
    if (!shadow.rays.empty())
        measured.shadow = prepared.traced->trace(shadow, {.shadow = true, .samples = 1}).hits;
    return measured;
}

nlohmann::json row_of(const LodOptions& options, const TraceDevice& device, const PrimitiveChoice& choice,
                      double times, double lod, const Measured& full, const Measured& less,
                      const DetailError& error) {
    return {{"model", options.model},
            {"primitive", choice.label()},
            {"device", device.name()},
            {"version", version_text()},
            {"distance", times},
            {"lod", lod},
            {"strands", less.strands},
            {"curves", less.curves},
            {"bytes", less.bytes},
            {"build_ms", less.build_ms},
            {"trace_ms", less.trace_ms},
            {"rays", less.primary.hits.size()},
            {"full_strands", full.strands},
            {"full_curves", full.curves},
            {"full_bytes", full.bytes},
            {"full_build_ms", full.build_ms},
            {"full_trace_ms", full.trace_ms},
            {"coverage", error.coverage},
            {"coverage_bias", error.coverage_bias},
            {"coverage_rms", error.coverage_rms},
            {"depth_bias_m", error.depth_bias},
            {"transmittance", error.transmittance},
            {"transmittance_bias", error.transmittance_bias}};
}

double ratio(double a, double b) { return b > 0 ? a / b : std::nan(""); }

Table empty_table() {
    return Table({{"primitive", "", true},
                  {"distance"},
                  {"detail L"},
                  {"strands"},
                  {"curves"},
                  {"bytes", "", true},
                  {"build", "ms"},
                  {"trace", "ms"},
                  {"full", "ms"},
                  {"coverage", "%"},
                  {"bias", "%"},
                  {"pixel rms", "%"},
                  {"depth bias", "mm"},
                  {"transmittance", "%"},
                  {"bias", "%"}},
                 3);
}

std::vector<std::string> cells(const PrimitiveChoice& choice, double times, double lod, const Measured& full,
                               const Measured& less, const DetailError& error) {
    return {choice.label(),
            significant(times),
            significant(lod),
            grouped(less.strands),
            grouped(less.curves),
            bytes_text(less.bytes),
            significant(less.build_ms),
            significant(less.trace_ms),
            significant(full.trace_ms),
            significant(100 * error.coverage),
            significant(100 * error.coverage_bias, 2),
            significant(100 * error.coverage_rms, 2),
            significant(1000 * error.depth_bias, 2),
            significant(100 * error.transmittance),
            significant(100 * error.transmittance_bias, 2)};
}

/// A chart's file name: letters, digits and '_' of the label.
std::string chart_name(const std::string& model, const std::string& label) {
    std::string name = "lod_" + model + "_" + label;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name + ".svg";
}

Scene scene_with(const std::string& model, double lod) {
    return load_scene(lod < 1 ? fmt::format("{},lod={:.9g}", model, lod) : model, {});
}

}  // namespace

int run_lod(const LodOptions& options) {
    if (!is_hair_mesh_spec(options.model))
        fail(ExitCode::usage, "lod {}: only hair meshes (FILE.hairmesh) have levels of detail",
             options.model);
    const Resolution size = parse_resolution(options.resolution);
    const std::vector<PrimitiveChoice> choices = options.primitives.choices();
    RayArguments ray_arguments;
    ray_arguments.camera = options.camera;
    ray_arguments.check();
    const TraceDevice device(options.device.options());
    const Scene full_scene = scene_with(options.model, 1);
    const Camera camera = camera_of(full_scene, ray_arguments, size);
    const glm::dvec3 to_light = light_direction(camera);
    const std::string name = hair_mesh_name(parse_hair_mesh_spec(options.model).file);
    Table table = empty_table();
    std::vector<std::vector<LodPoint>> charts(choices.size());
    for (double times = 1; times <= options.farthest; times *= 2) {
        const double lod = std::min(1.0, options.detail / times);
        const DistantView view = distant_view(camera, size.width, size.height, options.samples, times);
        const Rays primary = primary_rays(view.camera, {view.width, view.height, view.samples}, options.seed);
        const Scene less_scene = scene_with(options.model, lod);
        for (size_t c = 0; c < choices.size(); ++c) {
            // The shadow rays start at the full model's hits, found with this very primitive.
            Measured full = measure(device, full_scene, choices[c], primary, {}, 1);
            const Rays shadow = detail_shadow_rays(primary, full.primary, to_light, 0.002f);
            full = measure(device, full_scene, choices[c], primary, shadow, options.repeat);
            const Measured less = measure(device, less_scene, choices[c], primary, shadow, options.repeat);
            const DetailError error =
                compare_detail(full.primary, less.primary, view.samples, full.shadow, less.shadow);
            table.add_row(cells(choices[c], times, lod, full, less, error));
            const nlohmann::json row = row_of(options, device, choices[c], times, lod, full, less, error);
            if (!options.json.empty()) append_line(options.json, row.dump());
            charts[c].push_back({times, lod, error.coverage_bias, error.coverage_rms,
                                 error.transmittance_bias, ratio(double(less.bytes), double(full.bytes)),
                                 ratio(less.build_ms, full.build_ms), ratio(less.trace_ms, full.trace_ms)});
            inform("{} at {:g}x: done", choices[c].label(), times);
        }
        device.check_validation();
    }
    fmt::print("{}, {}, {} rays at every distance\n\n{}", device.name(), options.model,
               grouped(uint64_t(size.width) * size.height * options.samples),
               table.to_string(standard_output_style()));
    for (size_t c = 0; c < choices.size() && !options.charts.empty(); ++c) {
        const std::string path =
            (std::filesystem::path(options.charts) / chart_name(name, choices[c].label())).string();
        write_file(path,
                   lod_chart(fmt::format("{} through {} on {}", name, choices[c].label(), device.name()),
                             charts[c]));
        inform("{}", path);
    }
    return 0;
}

Command lod_command() {
    return {"lod", "level of detail of a hair mesh against distance: error, bytes, time",
            "  strandlab lod models/ringlets.hairmesh,strands=20000\n"
            "  strandlab lod models/bob.hairmesh --primitive rocaps --detail 2 --charts . --json rows.jsonl\n"
            "The picture keeps showing the whole model; its pixels grow with the distance. L = detail / "
            "distance, up to "
            "1.\n" +
                primitive_help(),
            [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<LodOptions>();
                app.add_option("MODEL", options->model, "FILE.hairmesh[,key=value,...]")->required();
                options->primitives.add_to(app, true);
                options->device.add_to(app);
                app.add_option("--detail", options->detail,
                               "level of detail at distance 1; above 1: full for longer")
                    ->check(CLI::Range(1e-4, 1e4))
                    ->capture_default_str();
                app.add_option("--farthest", options->farthest, "largest distance; it doubles from 1")
                    ->check(CLI::Range(1.0, 1024.0))
                    ->capture_default_str();
                app.add_option("--resolution", options->resolution, "WIDTHxHEIGHT at distance 1")
                    ->capture_default_str();
                app.add_option("--camera", options->camera, "eye=...:target=... or from=x,y,z[:zoom=factor]");
                app.add_option("--samples", options->samples, "rays per pixel at distance 1")
                    ->check(whole_number(1, 4096))
                    ->capture_default_str();
                app.add_option("--repeat", options->repeat, "times to trace; the median counts")
                    ->check(whole_number(1, 1000))
                    ->capture_default_str();
                app.add_option("--seed", options->seed, "of the places in a pixel")
                    ->check(whole_number(0, ~uint64_t(0)))
                    ->capture_default_str();
                app.add_option("--json", options->json, "append rows to this file, one JSON object a line");
                app.add_option("--charts", options->charts, "folder for one SVG chart for each primitive");
                return [options] { return run_lod(*options); };
            }};
}

}  // namespace strandlab
