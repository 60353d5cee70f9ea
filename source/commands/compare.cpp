// strandlab compare: the error measures for hits that another program wrote.
#include "base/error.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/hit_files.h"
#include "commands/usage_error.h"
#include "measure/bench_case.h"
#include "primitives/curved_pieces.h"
#include "report/comparison_text.h"
#include "report/result_json.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace strandlab {
namespace {

struct Options {
    std::string curves, strands, rays, hits, surface = "sphere", caps = "round";
    size_t error_rays = 0;
    bool json = false;
};

/// "sphere" and "disc" are the exact sweeps of the curves; anything else is a primitive's own surface.
Surface surface_named(const Options& options, const Curves& curves) {
    if (options.surface != "sphere" && options.surface != "disc") {
        const PrimitiveChoice choice = parse_primitive(options.surface, options.caps);
        return choice.primitive->surface(curves, choice.options);
    }
    const auto caps = caps_named(options.caps);
    if (!caps) fail(ExitCode::usage, "--caps {}: must be round, open or flat", options.caps);
    const bool sphere = options.surface == "sphere";
    if (!sphere && *caps == Caps::round)
        fail(ExitCode::usage, "--caps round: a swept disc has open or flat ends; pass --caps open");
    return curved_surface(curves, sphere ? Surface::Sweep::sphere : Surface::Sweep::disc, *caps);
}

int run(const Options& options) {
    const Scene scene = load_scene(options.curves, {}, options.strands);
    const Curves curves = all_curves(scene);
    MeasuredRays set;
    set.rays = load_ray_file(options.rays);
    const Hits hits = read_hits(options.hits, set.rays.rays.size());
    const size_t wanted = options.error_rays == 0 ? set.rays.rays.size() : options.error_rays;
    set.sample = error_sample(set.rays.rays.size(), wanted);
    set.sample_rays = selected(set.rays, set.sample);
    const std::vector<Surface> surfaces =
        surfaces_of(scene, [&](const Curves& model) { return surface_named(options, model); });
    const Reference reference = make_scene_reference(scene, surfaces, curves, set.sample_rays);
    Hits sample = selected(hits, set.sample);
    // The files do not say which instance was hit; the place does.
    for (size_t i = 0; i < sample.hits.size(); ++i) sample.hits[i].instance = reference.hits[i].instance;
    const Comparison comparison = compare_with(scene, curves, set, sample, reference,
                                               options.surface == "sphere" || options.surface == "disc");
    if (options.json)
        fmt::print("{}\n", to_line(to_json(comparison)));
    else
        fmt::print("{}", comparison_text(comparison, standard_output_style()));
    return 0;
}

}  // namespace

Command compare_command() {
    return {
        "compare", "errors of hits that another program wrote",
        "  strandlab compare --curves c.npy --rays r.npy --hits DIR --surface sphere --caps round\n"
        "  strandlab compare --curves c.npy --strands s.npy --rays r.npy --hits DIR --surface lss:segments=4 "
        "--json\n",
        [](CLI::App& app) -> RunCommand {
            auto options = std::make_shared<Options>();
            app.add_option("--curves", options->curves, "curves, float32 [N,4,4], or any model or scene")
                ->required();
            app.add_option("--strands", options->strands, "strands, int32 [S,2] (first curve, count)");
            app.add_option("--rays", options->rays, "rays, float32 [M,8]")->required();
            app.add_option("--hits", options->hits, "folder with t, curve and, if there, u and normal (.npy)")
                ->required();
            app.add_option(
                   "--surface", options->surface,
                   "what the hits should lie on: sphere, disc (exact sweeps), or a primitive's own surface, "
                   "as NAME[:key=value,...]")
                ->capture_default_str();
            app.add_option("--caps", options->caps, "strand ends of that surface: round, open, flat")
                ->capture_default_str();
            app.add_option("--error-rays", options->error_rays, "compare about this many rays (0: all)")
                ->capture_default_str()
                ->check(whole_number(0, 0xFFFFFFFF));
            app.add_flag("--json", options->json, "one JSON object instead of tables");
            return [options] { return run(*options); };
        }};
}

}  // namespace strandlab
