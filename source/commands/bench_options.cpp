#include "commands/bench_options.h"

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "commands/bench_presets.h"
#include "commands/usage_error.h"
#include "trace/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace strandlab {
namespace {

/// A text as a shell reads it back.
std::string quoted(const std::string& text) {
    constexpr std::string_view plain = "_-+=:,./@%^";
    bool is_plain = !text.empty();
    for (const char c : text)
        is_plain &= std::isalnum(static_cast<unsigned char>(c)) || plain.find(c) != std::string_view::npos;
    if (is_plain) return text;
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

/// A command line that grows option by option.
class CommandText {
  public:
    explicit CommandText(std::string command) : text_(std::move(command)) {}
    void add(const std::string& word) { text_ += " " + quoted(word); }
    void add(const char* option, const std::string& value) {
        text_ += std::string(" ") + option;
        add(value);
    }
    void flag(const char* option, bool is_set) {
        if (is_set) text_ += std::string(" ") + option;
    }
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

}  // namespace

void BenchOptions::add_to(CLI::App& app) {
    app.add_option("--preset", preset, preset_help())->capture_default_str();
    models.add_to(app, false);
    primitives.add_to(app, true);
    rays.add_to(app, "by preset");
    error_rays_ = app.get_option("--error-rays");
    device.add_to(app);
    app.add_option("--repeat", repeat, "timed traces of each case (default: by preset)")
        ->check(whole_number(1, 10000));
    app.add_option("--baseline-primitive", baseline_primitive,
                   "times as ratios to this one, round by round (default: the first)");
    app.add_option("--interleave", interleave,
                   "primitives whose samples alternate (0: as many as fit the device together)")
        ->capture_default_str()
        ->check(whole_number(0, 10000));
    app.add_option("--bytes-per-curve", bytes_per_curve, bytes_per_curve_help);
    app.add_option("--max-error", max_error,
                   "leave out cases with a model error p99 above this many radii, or over 1 % wrong rays");
    app.add_option("--max-memory", max_memory,
                   "leave out cases that keep more bytes than this on the device");
    app.add_option("--time-budget", time_budget, "seconds after which no more cases begin; --resume goes on");
    app.add_option("--shard", shard_text, "I/N: only the I-th of N parts of the sweep")
        ->capture_default_str();
    app.add_option("--json", json, "append rows to this file, one JSON object a line");
    app.add_option("--csv", csv, "append rows to this file");
    app.add_flag("--resume", resume, "leave out the cases that the --json file already holds");
    app.add_option("--baseline", baseline,
                   "compare with the rows of this file; exit 1 when slower or more wrong");
    app.add_option(
        "--save-rays", save_rays,
        "folder for the rays of every set, MODEL.SET.npy (MODEL.WxH.SET.npy where there are several "
        "resolutions), for trace and other programs");
    app.add_option(
        "--images", images,
        "folder for a picture of every case with primary rays; pictures from 1 to 32 times the distance "
        "are measured too");
    app.add_option("--scale-chart", scale_chart, "cost against the number of curves, as an SVG file");
    app.add_option("--leaf-order", leaf_order, "order of leaves in builds: auto, file, median")
        ->capture_default_str();
    app.add_flag("--no-compaction", no_compaction, "keep acceleration structures as built");
    app.add_flag("--low-memory", low_memory,
                 "smaller acceleration structures, slower to trace, where the driver can");
    app.add_option("--cull", cull, std::string(cull_help) + "; by each ray set on its own");
    app.add_option("--no-skip", no_skips, "force a skip off, repeatable; --explain lists them");
    app.add_flag("--explain", explain, "only print what tracing leaves out for these scenes and primitives");
    app.add_flag("--ablation", ablation,
                 "only measure what each of that saves, and that answers stay the same");
    app.add_flag(
        "--lod", lod,
        "only sweep levels of detail of the hair meshes against distance, 1x to 32x, as the command lod: "
        "error, bytes and times; --images: the folder for a chart of every primitive");
    app.add_flag(
        "--profile", profile,
        "also count what each trace takes (leaves, iterations, hits) in an instrumented run of its own, "
        "and measure the floors of its traversal");
    app.add_flag("--no-normals", no_normals, "write t, u and curve only: 16 bytes a ray")
        ->excludes("--images");
    app.add_flag("--no-embree", no_embree, "no row for Embree's round curves");
}

bool BenchOptions::has_error_rays() const { return error_rays_ != nullptr && error_rays_->count() > 0; }

void BenchOptions::check() const {
    check_preset(preset);
    rays.check();
    primitives.choices();
    models.curve_options();
    shard();
    order();
    device.options();
    if (!rays.resolution.empty()) resolutions();
    check_skips(no_skips);
    if (culling().is_any() && lod) fail(ExitCode::usage, "--cull {}: not with --lod; leave one out", cull);
    if (!scale_chart.empty()) check_appendable(scale_chart);
    const std::pair<const char*, double> limits[] = {{"--bytes-per-curve", bytes_per_curve},
                                                     {"--max-error", max_error},
                                                     {"--max-memory", max_memory},
                                                     {"--time-budget", time_budget}};
    for (const auto& [option, value] : limits)
        if (!(value >= 0)) fail(ExitCode::usage, "{} {}: must be a number from 0 (no limit)", option, value);
    if (resume && json.empty()) fail(ExitCode::usage, "--resume: name the file to go on with by --json");
    if (max_error > 0 && has_error_rays() && rays.error_rays == 0)
        fail(ExitCode::usage, "--max-error {}: no errors are measured with --error-rays 0", max_error);
}

SceneOptions::Order BenchOptions::order() const {
    if (leaf_order == "auto") return SceneOptions::Order::automatic;
    if (leaf_order == "file") return SceneOptions::Order::as_built;
    if (leaf_order == "median") return SceneOptions::Order::median;
    fail(ExitCode::usage, "--leaf-order {}: must be auto, file or median", leaf_order);
}

DeviceOptions BenchOptions::device_options() const {
    DeviceOptions options = device.options();
    options.pipeline_statistics = profile;
    return options;
}

Culling BenchOptions::culling() const {
    Culling allowed = parse_culling(cull);
    const auto is_off = [&](std::string_view skip) {
        return std::find(no_skips.begin(), no_skips.end(), skip) != no_skips.end();
    };
    if (is_off(reach_skip)) allowed.reach = false;
    if (is_off(detail_skip)) allowed.detail = 0;
    return allowed;
}

void BenchOptions::apply_to(SceneOptions& scene) const {
    scene.order = order();
    scene.compact = !no_compaction;
    scene.low_memory = low_memory;
    scene.traversal = device.asked_traversal();
    scene.normals = !no_normals;
    scene.no_skips = no_skips;
}

std::vector<Resolution> BenchOptions::resolutions() const {
    std::vector<Resolution> all;
    for (const std::string_view text : split(rays.resolution, ','))
        all.push_back(parse_resolution(std::string(text)));
    return all;
}

std::string to_string(const Resolution& resolution) {
    return fmt::format("{}x{}", resolution.width, resolution.height);
}

/// The --rays argument that makes a set again.
static std::string ray_argument(const RayFacts& rays) {
    std::string set = rays.kind, suffix;
    if (rays.shuffled) suffix += " shuffled";
    if (rays.as_shadow) suffix += " shadow";
    if (rays.kind == "file") set = rays.name.substr(0, rays.name.size() - suffix.size());
    std::replace(suffix.begin(), suffix.end(), ' ', ':');
    return set + suffix;
}

std::string reproducing_command(const BenchOptions& options, const ResultRow& row) {
    CommandText command("strandlab bench");
    command.add(row.model.spec);
    for (const auto& [option, value] : options.models.given()) command.add(option.c_str(), value);
    if (row.primitive.name != "embree") command.add("--primitive", row.primitive.label);
    if (row.ratio && row.ratio->baseline != row.primitive.label) {
        command.add("--primitive", row.ratio->baseline);
        command.add("--baseline-primitive", row.ratio->baseline);
    }
    if (!options.primitives.caps.empty()) command.add("--caps", options.primitives.caps);
    command.add("--rays", ray_argument(row.rays));
    command.add("--resolution", row.rays.resolution);
    if (!options.rays.camera.empty()) command.add("--camera", options.rays.camera);
    command.add("--seed", std::to_string(row.seed));
    command.add("--error-rays", std::to_string(row.settings.error_rays));
    command.add("--repeat", std::to_string(row.settings.repeat));
    if (!options.device.device.empty()) command.add("--device", options.device.device);
    if (options.device.traversal != "pipeline") command.add("--traversal", options.device.traversal);
    if (options.bytes_per_curve > 0)
        command.add("--bytes-per-curve", fmt::format("{}", options.bytes_per_curve));
    if (options.leaf_order != "auto") command.add("--leaf-order", options.leaf_order);
    command.flag("--no-compaction", options.no_compaction);
    command.flag("--low-memory", options.low_memory);
    if (!row.settings.cull.empty()) command.add("--cull", row.settings.cull);
    for (const std::string& skip : options.no_skips) command.add("--no-skip", skip);
    command.flag("--no-normals", options.no_normals);
    command.flag("--no-embree", row.primitive.name != "embree");
    if (!row.images.rendered.empty()) command.add("--images", options.images);
    return command.text();
}

}  // namespace strandlab
