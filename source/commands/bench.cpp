// strandlab bench: run time against memory and error, one row per case.
#include "base/error.h"
#include "base/progress.h"
#include "commands/arguments.h"
#include "commands/bench_table.h"
#include "commands/bundled_models.h"
#include "commands/command.h"
#include "commands/embree_case.h"
#include "commands/hit_files.h"
#include "commands/ray_arguments.h"
#include "commands/usage_error.h"
#include "report/images.h"
#include "report/result_writer.h"
#include "report/shading.h"
#include "trace/embree_reference.h"

#include <cstdio>
#include <filesystem>
#include <memory>

namespace strandlab {
namespace {

struct Options {
    ModelArguments models;
    PrimitiveArguments primitives;
    RayArguments rays;
    DeviceArguments device;
    uint32_t repeat = 5;
    std::string json, csv, images, save_rays, leaf_order = "auto";
    bool no_embree = false, no_compaction = false, no_normals = false;
};

SceneOptions::Order leaf_order_named(const std::string& name) {
    if (name == "auto") return SceneOptions::Order::automatic;
    if (name == "file") return SceneOptions::Order::as_built;
    if (name == "median") return SceneOptions::Order::median;
    fail(ExitCode::usage, "--leaf-order {}: must be auto, file or median", name);
}

/// One run of the command over all scenes.
class Bench {
  public:
    explicit Bench(const Options& options)
        : options_(options),
          choices_(options.primitives.choices()),
          caps_(options.primitives.scene_caps()),
          order_(leaf_order_named(options.leaf_order)),
          curve_options_(options.models.curve_options()),
          device_({options.device.device, options.device.validation}),
          writer_(options.json, options.csv),
          context_(current_context()) {
        const bool slow = device_.info().kind == "cpu";
        size_ = options.rays.resolution.empty() ? (slow ? Resolution{640, 360} : Resolution{1920, 1080})
                                                : parse_resolution(options.rays.resolution);
        // An idle GPU needs a third of a second of work before it runs at its full clock.
        // Elsewhere one trace: drivers compile at the first dispatch.
        warm_up_ms_ = slow ? 1e-6 : 300;
        if (!options.images.empty()) prepare_images();
        fmt::print("{}\n", device_line());
    }

    void run(const std::string& path) const {
        const Scene scene = load_scene(path, curve_options_);
        if (scene.curve_count() == 0) return;
        const Curves curves = all_curves(scene);
        const RaySets rays(scene, curves, options_.rays, size_, caps_);
        CaseInput input{device_, scene, curves, options_.repeat, warm_up_ms_, {}};
        input.options.order = order_;
        input.options.compact = !options_.no_compaction;
        input.options.normals = !options_.no_normals;
        input.options.ray_extent = object_extent(scene, rays.extent());
        if (!options_.save_rays.empty())
            for (const MeasuredRays& set : rays.sets()) write_rays(options_.save_rays, scene.name, set.rays);
        for (const std::vector<ResultRow>& rows : run_cases(input, rays.sets()))
            fmt::print("\n{}", bench_table(rows));
        std::fflush(stdout);
    }

    void finish() const {
        device_.check_validation();
        fmt::print("\n{}", bench_legend());
    }

  private:
    /// The rows of each ray set.
    std::vector<std::vector<ResultRow>> run_cases(const CaseInput& input,
                                                  const std::vector<MeasuredRays>& sets) const {
        const bool with_embree = !options_.no_embree && embree_available() && input.scene.is_plain();
        Progress progress(input.scene.name, sets.size() * (choices_.size() + (with_embree ? 1 : 0)));
        std::vector<std::vector<ResultRow>> rows(sets.size());
        for (const PrimitiveChoice& choice : choices_) {
            const PreparedCase prepared = prepare_case(input, choice);
            for (size_t i = 0; i < sets.size(); ++i) {
                rows[i].push_back(run_one(input, prepared, sets[i]));
                progress.tick();
            }
        }
        for (size_t i = 0; with_embree && i < sets.size(); ++i) {
            rows[i].push_back(embree_row(input, sets[i], base_row(input, sets[i])));
            progress.tick();
        }
        return rows;
    }

    std::string device_line() const {
        const DeviceFacts facts = facts_of(device_.info(), device_.has_validation());
        return fmt::format("{}, {}, {} traversal, {} x {}, {} samples, validation layers {}", facts.name,
                           facts.driver, facts.device_class(), size_.width, size_.height, options_.repeat,
                           facts.validation_layers ? "on: times are not comparable" : "off");
    }

    ResultRow base_row(const CaseInput& input, const MeasuredRays& rays) const {
        ResultRow row;
        row.model = facts_of(input.scene.name, input.curves, input.scene.instances.size());
        row.rays = facts_of(rays.rays, rays.rays.name == "primary" ? 1 : 0);
        row.device = facts_of(device_.info(), device_.has_validation());
        row.seed = options_.rays.seed;
        row.context = context_;
        return row;
    }

    ResultRow run_one(const CaseInput& input, const PreparedCase& prepared, const MeasuredRays& rays) const {
        CaseResult result = run_case(input, prepared, rays);
        ResultRow row = base_row(input, rays);
        row.primitive = facts_of(prepared.choice, caps_);
        row.trace_ms = std::move(result.trace_ms);
        row.geometry_ms = prepared.geometry_ms;
        row.cost = prepared.traced->cost();
        row.intersector_error = std::move(result.own);
        row.model_error = std::move(result.model);
        writer_.add(row);
        if (!options_.images.empty() && rays.rays.name == "primary") write_picture(input, prepared, rays);
        return row;
    }

    void prepare_images() const {
        std::error_code error;
        std::filesystem::create_directories(options_.images, error);
        if (error) fail(ExitCode::bad_input, "--images {}: {}", options_.images, error.message());
        check_image_path((std::filesystem::path(options_.images) / "x.png").string());
    }

    void write_picture(const CaseInput& input, const PreparedCase& prepared, const MeasuredRays& rays) const {
        const TraceResult trace = prepared.traced->trace(rays.rays, {});
        std::string name = input.scene.name + "_" + prepared.choice.label() + ".png";
        for (char& c : name)
            if (c == ':' || c == ',' || c == '=' || c == '/') c = '_';
        ShadingOptions shading;
        shading.width = size_.width;
        shading.height = size_.height;
        write_image((std::filesystem::path(options_.images) / name).string(),
                    shade(rays.rays, trace.hits, input.curves, shading));
    }

    const Options& options_;
    std::vector<PrimitiveChoice> choices_;
    Caps caps_;
    SceneOptions::Order order_;
    CurveOptions curve_options_;
    TraceDevice device_;
    ResultWriter writer_;
    Context context_;
    Resolution size_;
    double warm_up_ms_ = 0;
};

int run(Options& options) {
    if (options.models.models.empty()) options.models.models = bundled_models();
    if (options.rays.names.empty()) options.rays.names = {"primary", "secondary"};
    options.rays.check();
    const Bench bench(options);
    for (const std::string& model : options.models.models) bench.run(model);
    bench.finish();
    return 0;
}

}  // namespace

Command bench_command() {
    return {
        "bench", "compare primitives: time, memory and error",
        "  strandlab bench\n"
        "  strandlab bench hair.hair --primitive lss:segments=8 --primitive prhi --rays primary --rays "
        "shadow\n"
        "  strandlab bench hair.tfx --resolution 1280x720 --json results.jsonl --images pictures\n" +
            primitive_help(),
        [](CLI::App& app) -> RunCommand {
            auto options = std::make_shared<Options>();
            options->models.add_to(app, false);
            options->primitives.add_to(app, true);
            options->rays.add_to(app, "primary, secondary");
            options->device.add_to(app);
            app.add_option("--repeat", options->repeat, "timed traces of each case")
                ->capture_default_str()
                ->check(whole_number(1, 10000));
            app.add_option("--json", options->json, "append rows to this file, one JSON object a line");
            app.add_option("--csv", options->csv, "append rows to this file");
            app.add_option("--save-rays", options->save_rays,
                           "folder for the rays of every set, MODEL.SET.npy, for trace and other programs");
            app.add_option("--images", options->images,
                           "folder for a picture of every case with primary rays");
            app.add_option("--leaf-order", options->leaf_order,
                           "order of leaves in builds: auto, file, median")
                ->capture_default_str();
            app.add_flag("--no-compaction", options->no_compaction, "keep acceleration structures as built");
            app.add_flag("--no-normals", options->no_normals, "write t, u and curve only: 16 bytes a ray")
                ->excludes("--images");
            app.add_flag("--no-embree", options->no_embree, "no row for Embree's round curves");
            return [options] { return run(*options); };
        }};
}

}  // namespace strandlab
