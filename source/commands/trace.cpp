// strandlab trace: other people's rays and curves in, hits out.
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/hit_files.h"
#include "commands/usage_error.h"
#include "measure/bench_case.h"
#include "measure/statistics.h"
#include "trace/culling.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>

namespace strandlab {
namespace {

struct Options {
    std::string curves, strands, rays, output, cull;
    PrimitiveArguments primitive;
    DeviceArguments device;
    uint32_t repeat = 1;
    bool shadow = false, no_normals = false;
};

nlohmann::ordered_json statistics_of(const Options& options, const PreparedCase& prepared,
                                     const TraceDevice& device, const TraceResult& result) {
    const SceneCost& cost = prepared.traced->cost();
    size_t hits = 0;
    for (const Hit& hit : result.hits.hits) hits += hit.is_hit() ? 1 : 0;
    const double median = summarise(result.milliseconds).median;
    return {{"primitive", prepared.choice.primitive->name},
            {"parameters",
             prepared.choice.options.parameters.to_string(prepared.choice.primitive->parameters, true)},
            {"caps", name_of(prepared.choice.options.caps)},
            {"device", device.name()},
            {"driver", device.info().driver},
            {"device_class", device.info().has_ray_tracing_hardware ? "hardware" : "software"},
            {"validation", device.has_validation()},
            {"curves", options.curves},
            {"rays", result.hits.hits.size()},
            {"hits", hits},
            {"trace_ms", result.milliseconds},
            {"mrays_per_s", median > 0 ? double(result.hits.hits.size()) / median * 1e-3 : 0.0},
            {"geometry_ms", prepared.geometry_ms},
            {"order_ms", cost.order_ms},
            {"build_ms", cost.builds.build_ms},
            {"compaction_ms", cost.builds.compaction_ms},
            {"input_bytes", cost.builds.input_bytes},
            {"structure_bytes", cost.builds.built_bytes},
            {"kept_structure_bytes", cost.builds.kept_bytes},
            {"scratch_bytes", cost.builds.scratch_bytes},
            {"peak_build_bytes", cost.builds.peak_bytes},
            {"record_bytes", cost.record_bytes},
            {"leaves", cost.leaf_count}};
}

nlohmann::ordered_json statistics_of(const CulledScene& culled, const Culling& culling) {
    return {{"allowed", culling.to_string()},
            {"out_of_reach_strands", culled.out_of_reach.strands},
            {"out_of_reach_curves", culled.out_of_reach.curves},
            {"too_small_strands", culled.too_small.strands},
            {"too_small_curves", culled.too_small.curves},
            {"cull_ms", culled.milliseconds}};
}

int run(const Options& options) {
    if (options.primitive.primitives.empty())
        fail(ExitCode::usage, "trace needs --primitive NAME[:key=value,...]");
    const PrimitiveChoice choice = options.primitive.choices().front();
    const Culling culling = parse_culling(options.cull);
    const Scene scene = load_scene(options.curves, {}, options.strands);
    const Rays rays = load_ray_file(options.rays);
    const TraceDevice device(options.device.options());
    const Curves curves = all_curves(scene);
    CaseInput input{device, scene, curves};
    input.options.normals = !options.no_normals && !options.shadow;
    input.options.traversal = options.device.asked_traversal();
    input.options.ray_extent = object_extent(scene, extent_of(rays));
    std::optional<CulledScene> culled;
    if (culling.is_any()) input.culled = &culled.emplace(cull(scene, culling, rays.rays));
    const PreparedCase prepared = prepare_case(input, choice);
    const TraceResult result =
        prepared.traced->trace(rays, {.shadow = options.shadow, .samples = options.repeat, .warm_up_ms = 0});
    device.check_validation();
    write_hits(options.output, result.hits);
    nlohmann::ordered_json statistics = statistics_of(options, prepared, device, result);
    if (culled) statistics["cull"] = statistics_of(*culled, culling);
    write_file((std::filesystem::path(options.output) / "stats.json").string(), statistics.dump(2) + "\n");
    inform("{}: {} rays through {} on {}", options.output, rays.rays.size(), choice.label(), device.name());
    return 0;
}

}  // namespace

Command trace_command() {
    return {"trace", "trace rays of a file through curves of a file, write the hits",
            "  strandlab trace --curves c.npy --strands s.npy --rays r.npy --primitive prhi --out hits\n"
            "  strandlab trace --curves hair.hair --rays r.npy --primitive rocaps:splits=8 --caps open --out "
            "hits\n" +
                primitive_help(),
            [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<Options>();
                app.add_option("--curves", options->curves, "curves, float32 [N,4,4], or any model or scene")
                    ->required();
                app.add_option("--strands", options->strands, "strands, int32 [S,2] (first curve, count)");
                app.add_option("--rays", options->rays, "rays, float32 [M,8]: origin, tmin, direction, tmax")
                    ->required();
                options->primitive.add_to(app, false);
                options->device.add_to(app);
                app.add_option("-o,--out", options->output,
                               "folder for t, curve, u, normal (.npy) and stats.json")
                    ->required();
                app.add_option("--cull", options->cull, cull_help);
                app.add_option("--repeat", options->repeat, "times to trace; stats.json keeps each time")
                    ->check(whole_number(1, 10000));
                app.add_flag("--shadow", options->shadow, "any hit will do: t is tmin and curve 0 for a hit");
                app.add_flag("--no-normals", options->no_normals, "leave normal.npy out (faster)");
                return [options] { return run(*options); };
            }};
}

}  // namespace strandlab
