// strandlab stress: every primitive on families of hard pairs of a ray and a strand.
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "commands/arguments.h"
#include "commands/command.h"
#include "commands/stress_report.h"
#include "commands/stress_run.h"
#include "trace/embree_reference.h"
#include "trace/scene_reference.h"
#include "trace/skips.h"
#include "trace/trace_device.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace strandlab {
namespace {

struct Options {
    PrimitiveArguments primitives;
    std::vector<std::string> families, devices, no_skips;
    double pairs = 20000, embree_pairs = 20000;
    uint64_t seed = default_stress_seed;
    std::string json, heat_map, worst_folder, agree;
    uint32_t worst = 10;
    bool self_intersection = false, watertight = false;
};

using Devices = std::vector<StressDevice>;

std::vector<std::string> default_devices(const Options& options) {
    if (options.self_intersection || options.watertight) return {"cpu-float"};
    if (!options.agree.empty()) return {""};
    return {"cpu-float", "cpu-double"};
}

/// What the C++ float version says is wanted by every Vulkan device: computed at most once.
class PlainHits {
  public:
    PlainHits(const Primitive& primitive, const Geometry& geometry, const StressPairs& pairs)
        : primitive_(primitive), geometry_(geometry), pairs_(pairs) {}
    const std::vector<StressHit>& get() {
        if (hits_.empty()) hits_ = intersect_pairs(primitive_, geometry_, pairs_, Precision::single, boxes_);
        return hits_;
    }
    BoxCheck boxes() const { return boxes_; }

  private:
    const Primitive& primitive_;
    const Geometry& geometry_;
    const StressPairs& pairs_;
    std::vector<StressHit> hits_;
    BoxCheck boxes_;
};

/// One primitive on every device; cells: one for each device.
void run_choice(const PrimitiveChoice& choice, const Curves& curves, const StressPairs& pairs,
                Devices& devices, size_t keep, std::span<StressCell> cells) {
    const Primitive& primitive = *choice.primitive;
    const Geometry geometry = primitive.build(curves, choice.options);
    PlainHits plain(primitive, geometry, pairs);
    for (size_t d = 0; d < devices.size(); ++d) {
        StressTally& tally = cells[d].tally;
        if (devices[d].is_gpu()) {
            const PairScene scene = devices[d].scene(primitive, geometry, pairs.range, extent_of(pairs.rays));
            const std::vector<StressHit> hits = scene.trace(pairs.rays);
            add_errors(pairs, hits, keep, tally);
            add_difference(curves, pairs.rays, hits, plain.get(), tally.agreement);
        } else if (cells[d].precise) {
            const auto hits = intersect_pairs(primitive, geometry, pairs, Precision::precise, tally.boxes);
            add_errors(pairs, hits, keep, tally);
        } else {
            add_errors(pairs, plain.get(), keep, tally);
            tally.boxes.add(plain.boxes());
            count_iterations(primitive, geometry, pairs, tally.iterations);
        }
    }
}

/// All primitives on some pairs of one family. Primitives with the same surface share rays and answers.
void run_chunk(const StressRange& range, std::span<const PrimitiveChoice> choices, Devices& devices,
               size_t keep, std::span<StressCell> cells, Progress& progress) {
    const Curves curves = stress_strands(range);
    std::vector<std::pair<uint64_t, StressPairs>> known;  // by the hash of their surface
    for (size_t c = 0; c < choices.size(); ++c) {
        const PrimitiveChoice& choice = choices[c];
        const Surface surface = choice.primitive->surface(curves, choice.options);
        const uint64_t key = hash(surface);
        auto found = std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.first == key; });
        if (found == known.end()) found = known.insert(known.end(), {key, stress_pairs(range, surface)});
        run_choice(choice, curves, found->second, devices, keep, cells.subspan(c * devices.size()));
        progress.tick(range.count);
    }
}

std::vector<StressCell> make_cells(const StressFamily& family, std::span<const PrimitiveChoice> choices,
                                   const Devices& devices) {
    std::vector<StressCell> cells;
    for (const PrimitiveChoice& choice : choices)
        for (const StressDevice& device : devices) {
            StressCell& cell = cells.emplace_back();
            cell.family = &family;
            cell.primitive = choice.primitive;
            cell.label = choice.label();
            cell.device = device.name();
            cell.precise = device.name() == "cpu-double";
        }
    return cells;
}

/// Embree's round curves on the swept discs that they are: a row to compare with, not to judge.
StressCell embree_cell(const StressFamily& family, uint64_t seed, uint64_t count, size_t keep) {
    const PrimitiveChoice discs = parse_primitive("prhi", "open");
    StressCell cell;
    cell.family = &family;
    cell.label = "Embree " + embree_version();
    cell.device = "round Bezier";
    for (const StressRange& range : stress_ranges(family, count, seed)) {
        const Surface surface = discs.primitive->surface(stress_strands(range), discs.options);
        const StressPairs pairs = stress_pairs(range, surface);
        add_errors(pairs, trace_pairs_with_embree(surface, pairs), keep, cell.tally);
    }
    cell.judgement.text = "a second opinion, with limits of its own";
    return cell;
}

std::vector<const StressFamily*> chosen_families(const std::vector<std::string>& names) {
    std::vector<const StressFamily*> families;
    for (const std::string& name : names) families.push_back(&stress_family(name));
    if (names.empty())
        for (const StressFamily& family : stress_families()) families.push_back(&family);
    return families;
}

StressRun make_run(const Options& options) {
    if (!(options.pairs >= 1 && options.pairs <= 1e15))
        fail(ExitCode::usage, "--pairs {}: must be a number from 1 to 1e15", options.pairs);
    if (options.self_intersection + options.watertight + !options.agree.empty() > 1)
        fail(ExitCode::usage, "--self-intersection, --watertight, --agree: pass one of them");
    if (!options.agree.empty() && options.agree != "cpu-float")
        fail(ExitCode::usage, "--agree {}: devices are compared with cpu-float", options.agree);
    check_skips(options.no_skips);
    for (const std::string& path : {options.json, options.heat_map})
        if (!path.empty()) check_appendable(path);  // before a night of work, not after it
    StressRun run;
    run.families = chosen_families(options.families);
    run.choices = options.primitives.choices();
    for (const std::string& name : options.devices.empty() ? default_devices(options) : options.devices)
        run.devices.push_back(std::make_unique<TraceDevice>(DeviceOptions{name, false}));
    run.pairs = static_cast<uint64_t>(options.pairs);
    run.seed = options.seed;
    run.no_skips = options.no_skips;
    run.json = options.json;
    return run;
}

/// All cells of one family.
void run_family(const StressRun& run, const StressFamily& family, const Options& options, Devices& devices,
                Progress& progress, std::vector<StressCell>& all) {
    const size_t keep = options.worst_folder.empty() ? 0 : options.worst;
    std::vector<StressCell> cells = make_cells(family, run.choices, devices);
    for (const StressRange& range : stress_ranges(family, run.pairs, run.seed))
        run_chunk(range, run.choices, devices, keep, cells, progress);
    for (size_t i = 0; i < cells.size(); ++i) {
        StressCell& cell = cells[i];
        auto limits = stress_limits(cell.primitive->name, family, cell.precise);
        const bool is_driver =
            devices[i % devices.size()].is_gpu() && cell.primitive->shaders.intersection.empty();
        if (is_driver && limits) limits->judged = false, limits->reason = "the driver's own triangle test";
        cell.judgement = judge(cell.tally, limits, family, cell.precise);
        if (keep > 0) write_worst(cell, run.seed, options.worst_folder);
        all.push_back(std::move(cell));
    }
    const uint64_t embree_count =
        embree_available() ? static_cast<uint64_t>(std::clamp(options.embree_pairs, 0.0, 1e15)) : 0;
    if (embree_count > 0)
        all.push_back(embree_cell(family, run.seed, std::min(embree_count, run.pairs), keep));
}

int run_errors(const StressRun& run, const Options& options) {
    Devices devices = devices_of(run);
    std::vector<StressCell> all;
    {
        Progress progress("stress", run.pairs * run.families.size() * run.choices.size());
        for (const StressFamily* family : run.families)
            run_family(run, *family, options, devices, progress, all);
    }
    std::fputs(stress_table(all).c_str(), stdout);
    std::fputs(stress_summary(all).c_str(), stdout);
    if (!options.json.empty()) write_file(options.json, stress_json(all, options.seed, run.no_skips));
    if (!options.heat_map.empty()) write_file(options.heat_map, stress_heat_map(all));
    const bool fails = std::any_of(all.begin(), all.end(), [](const StressCell& cell) {
        return cell.judgement.verdict == StressVerdict::fails;
    });
    return static_cast<int>(fails ? ExitCode::threshold : ExitCode::ok);
}

int run(const Options& options) {
    const StressRun stress = make_run(options);
    if (options.self_intersection) return run_self_intersection(stress);
    if (options.watertight) return run_watertight(stress);
    if (!options.agree.empty()) return run_agreement(stress);
    return run_errors(stress, options);
}

RunCommand declare(CLI::App& app) {
    auto options = std::make_shared<Options>();
    options->primitives.add_to(app, true);
    app.add_option("--family", options->families, "family of pairs, repeatable (default: all, see below)")
        ->allow_extra_args(false);
    app.add_option("--device", options->devices,
                   "cpu-float, cpu-double or a Vulkan device (see strandlab info), repeatable (default: the "
                   "first two; what --agree is about: the best Vulkan device)")
        ->allow_extra_args(false);
    app.add_option(
           "--no-skip", options->no_skips,
           "force a skip of Vulkan devices off, repeatable (see strandlab bench --explain): rounding, "
           "to have them round as C++ does")
        ->allow_extra_args(false);
    app.add_option("--pairs", options->pairs, "pairs of every family; 1e8 takes a night")
        ->capture_default_str();
    app.add_option("--embree-pairs", options->embree_pairs,
                   "at most so many pairs of every family for Embree's curves, where built in (0: none)")
        ->capture_default_str();
    app.add_option("--seed", options->seed, "other pairs for other seeds")->capture_default_str();
    app.add_flag(
        "--self-intersection", options->self_intersection,
        "instead: rays that leave the hits, at the robust offset of each primitive and at smaller ones; "
        "and whether shadow rays get the same answer");
    app.add_flag("--watertight", options->watertight,
                 "instead: whether the box of any leaf loses a hit that the intersector alone finds");
    app.add_option(
        "--agree", options->agree,
        "cpu-float; instead: how far a Vulkan device's hits are from those of the C++ float version");
    app.add_option("--json", options->json, "write one JSON object a line and cell");
    app.add_option("--heat-map", options->heat_map, "write family x primitive as a picture (.svg)");
    app.add_option("--worst-folder", options->worst_folder,
                   "write the worst pairs as .npy files of curves and rays, for strandlab trace");
    app.add_option("--worst", options->worst, "how many of each cell")->capture_default_str();
    return [options] { return run(*options); };
}

constexpr const char* examples =
    "  strandlab stress                                      all primitives on this processor\n"
    "  strandlab stress --device llvmpipe --primitive lss    one on a Vulkan device\n"
    "  strandlab stress --family grazing --pairs 1e6 --json grazing.jsonl\n"
    "  strandlab stress --primitive rocaps:variant=published --worst-folder worst --worst 3\n"
    "  strandlab stress --self-intersection --pairs 2000     rays that leave a hit must not meet it again\n"
    "  strandlab stress --watertight --pairs 2.5e5           boxes lose no hit: 11 million pairs a "
    "primitive\n"
    "  strandlab stress --agree cpu-float --device llvmpipe  a device's float against C++ float\n";

}  // namespace

Command stress_command() {
    return {"stress", "intersectors on hard pairs of ray and strand, against the oracle of their own surface",
            std::string(examples) + "\n" + stress_family_help(), declare};
}

}  // namespace strandlab
