#include "base/error.h"
#include "base/hash.h"
#include "base/log.h"
#include "commands/bench_block.h"
#include "commands/bench_presets.h"
#include "commands/embree_case.h"
#include "commands/hit_files.h"
#include "measure/memory_budget.h"
#include "measure/pareto.h"
#include "report/file_name.h"
#include "report/images.h"
#include "report/profile_table.h"
#include "report/result_json.h"
#include "report/result_table.h"
#include "strands/models.h"
#include "trace/embree_reference.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

namespace strandlab {

using Json = nlohmann::ordered_json;

namespace {

/// The baseline primitive's place among the choices: the first without a name.
size_t baseline_index(const std::vector<PrimitiveChoice>& choices, const std::string& name) {
    if (name.empty()) return 0;
    const size_t index = index_of(choices, parse_primitive(name));
    if (index == choices.size())
        fail(ExitCode::usage, "--baseline-primitive {}: is none of the sweep's; add --primitive {}", name,
             name);
    return index;
}

RayFacts ray_facts(const MeasuredRays& rays, uint64_t seed, const std::string& resolution) {
    RayFacts facts = facts_of(rays.rays, rays.is_picture ? 1 : 0);
    facts.kind = rays.kind;
    facts.shuffled = rays.shuffled;
    facts.as_shadow = rays.as_shadow;
    facts.seed = seed;
    facts.camera = rays.camera;
    facts.resolution = resolution;
    return facts;
}

std::optional<TimeRatio> ratio_to(const TimeSamples& baseline, const TimeSamples& samples,
                                  const PrimitiveChoice& choice) {
    TimeRatio ratio{choice.label(), {}};
    for (size_t i = 0; i < samples.device_ms.size(); ++i)
        ratio.samples.push_back(samples.device_ms[i] / baseline.device_ms[i]);
    return ratio;
}

void prepare_image_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(ExitCode::bad_input, "--images {}: {}", folder, error.message());
    check_image_path((std::filesystem::path(folder) / "x.png").string());
}

/// Ray sets from files by the files' names alone.
std::vector<std::string> without_folders(std::vector<std::string> sets) {
    for (std::string& set : sets)
        if (const size_t end = set.rfind(".npy"); end != std::string::npos)
            set = std::filesystem::path(set.substr(0, end)).filename().string() + set.substr(end + 4);
    return sets;
}

}  // namespace

BenchRun::BenchRun(BenchOptions& options)
    : options_(options),
      device_(options.device_options()),
      caps_(options.primitives.scene_caps()),
      culling_(options.culling()),
      curve_options_(options.models.curve_options()),
      shard_(options.shard()),
      context_(current_context()),
      start_(std::chrono::steady_clock::now()) {
    apply_preset(options_, device_.info());
    options_.rays.check();
    choices_ = options_.primitives.choices();
    resolutions_ = options_.resolutions();
    with_embree_ = embree_available() && !options_.no_embree;
    baseline_ = baseline_index(choices_, options_.baseline_primitive);
    // Names, not paths: parts of a sweep may run on machines with other folders.
    SweepAxes axes{{}, {}, options_.rays.set_names(), {}};
    for (const std::string& model : options_.models.models) axes.models.push_back(model_name(model));
    for (const Resolution& resolution : resolutions_) axes.resolutions.push_back(to_string(resolution));
    for (const PrimitiveChoice& choice : choices_) axes.primitives.push_back(choice.label());
    if (with_embree_) axes.primitives.emplace_back(embree_label);
    sweep_id_ = axes.hash(fmt::format("seed={} caps={}", options_.rays.seed, name_of(caps_)));
    model_files_ = file_names_of(axes.models);
    ray_files_ = file_names_of(without_folders(axes.rays));
    primitive_files_ = file_names_of(axes.primitives);
    axes_ = std::make_shared<SweepAxes>(std::move(axes));

    writer_ = std::make_unique<ResultWriter>(options_.json, options_.csv, options_.resume);
    for (const Json& row : writer_->rows())
        if (const auto key = row.find("key"); key != row.end() && key->is_string()) finished_[*key] = row;
    if (!options_.images.empty()) prepare_image_folder(options_.images);
    fmt::print("{}\n", device_line());
}

std::string BenchRun::device_line() const {
    const DeviceFacts facts = facts_of(device_.info(), device_.has_validation());
    std::string sizes;
    for (const std::string& size : axes_->resolutions) sizes += (sizes.empty() ? "" : ", ") + size;
    const std::string shard =
        shard_.count == 1 ? "" : fmt::format(", part {} of {}", shard_.index, shard_.count);
    return fmt::format("{}, {}, {} traversal, {}, {} samples, {} cases{}, validation layers {}", facts.name,
                       facts.driver, facts.device_class(), sizes, *options_.repeat, axes_->cases(), shard,
                       facts.validation_layers ? "on: times are not comparable" : "off");
}

void BenchRun::run() {
    for (size_t model = 0; model < axes_->models.size() && !is_over_budget(); ++model) run_model(model);
    if (left_out_ > 0) inform("{} cases lie beyond --max-error or --max-memory and have no row", left_out_);
    if (is_over_budget())
        warn("--time-budget {}: the sweep may not be complete; --resume goes on", options_.time_budget);
}

bool BenchRun::is_over_budget() const {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    return options_.time_budget > 0 && spent.count() > options_.time_budget;
}

void BenchRun::run_model(size_t model) {
    const size_t first = axes_->number(model, 0, 0, 0), end = axes_->number(model + 1, 0, 0, 0);
    bool wanted = false;
    for (size_t number = first; number < end; ++number) wanted |= is_wanted(number);
    if (!wanted) return;
    const Scene scene = load_scene(options_.models.models[model], curve_options_);
    if (scene.curve_count() == 0) return;
    const Curves curves = all_curves(scene);
    for (size_t i = 0; i < resolutions_.size() && !is_over_budget(); ++i) run_block(model, i, scene, curves);
}

void BenchRun::run_block(size_t model, size_t resolution, const Scene& scene, const Curves& curves) {
    std::vector<bool> wanted(axes_->rays.size(), false);
    for (size_t set = 0; set < wanted.size(); ++set)
        for (size_t primitive = 0; primitive < axes_->primitives.size(); ++primitive)
            if (is_wanted(axes_->number(model, resolution, set, primitive))) wanted[set] = true;
    if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) return;

    Block block{model,
                resolution,
                scene,
                curves,
                facts_of(scene.name, curves, scene.instances.size()),
                RaySets(scene, curves, options_.rays, resolutions_[resolution], caps_, wanted),
                {},
                {device_, scene, curves, *options_.repeat, warm_up_of(device_.info()), {}},
                {}};
    block.facts.spec = options_.models.models[model];
    for (size_t set = 0; set < wanted.size(); ++set)
        block.ray_facts.push_back(wanted[set] ? ray_facts(block.rays.sets()[set], options_.rays.seed,
                                                          axes_->resolutions[resolution])
                                              : RayFacts{});
    options_.apply_to(block.input.options);
    block.input.options.build_warm_up_ms = block.input.warm_up_ms;
    block.input.options.ray_extent = object_extent(scene, block.rays.extent());
    if (!options_.save_rays.empty())
        for (size_t set = 0; set < wanted.size(); ++set)
            if (wanted[set])
                write_rays(options_.save_rays, file_stem(block, ".") + "." + ray_files_[set],
                           block.rays.sets()[set].rays);
    block.open = open_cases(block);

    measure_distances(block);

    std::vector<size_t> sets;
    for (size_t set = 0; set < wanted.size(); ++set)
        if (wanted[set]) sets.push_back(set);
    if (!culling_.is_any()) measure_sets(block, sets);
    for (size_t i = 0; i < sets.size() && culling_.is_any(); ++i) measure_culled(block, sets[i]);
    measure_embree(block);

    std::vector<Json> rows;
    for (auto& [number, row] : block.rows) rows.push_back(std::move(row));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    if (!rows.empty()) fmt::print("\n{}", result_table(rows));
    if (options_.profile) fmt::print("\n{}", profile_table(rows));
    std::fflush(stdout);
}

void BenchRun::measure_sets(Block& block, const std::vector<size_t>& sets) {
    std::vector<size_t> waiting;
    for (size_t primitive = 0; primitive < choices_.size(); ++primitive)
        if (std::any_of(sets.begin(), sets.end(), [&](size_t set) { return block.is_open(set, primitive); }))
            waiting.push_back(primitive);
    if (waiting.empty() || is_over_budget()) return;
    const std::vector<PrimitiveChoice> choices = choices_within_memory(block);
    SceneGroups groups(block.input, choices, baseline_, waiting,
                       group_limits(device_.info(), options_.interleave));
    while (!is_over_budget()) {
        const auto group = groups.next();
        if (group.empty()) break;
        for (size_t i = 0; i < sets.size() && !is_over_budget(); ++i)
            measure_set(block, sets[i], group, groups.baseline());
    }
}

// By each set on its own, so that a row does not depend on which other sets its run measures.
void BenchRun::measure_culled(Block& block, size_t set) {
    const bool has_any = std::any_of(block.open.begin(), block.open.end(), [&](const Case& one) {
        return one.set == set && one.primitive < choices_.size();
    });
    if (!has_any || is_over_budget()) return;
    const CulledScene culled = cull(block.scene, culling_, block.rays.sets()[set].rays.rays);
    inform("{}, {} rays: {} of {} strands are not built ({} out of reach, {} too small)", block.scene.name,
           block.rays.sets()[set].rays.name, culled.left_out().strands, block.scene.strand_count(),
           culled.out_of_reach.strands, culled.too_small.strands);
    block.input.culled = &culled;
    measure_sets(block, {set});
    block.input.culled = nullptr;
}

std::vector<PrimitiveChoice> BenchRun::choices_within_memory(const Block& block) const {
    std::vector<PrimitiveChoice> choices = choices_;
    if (options_.bytes_per_curve > 0)
        for (PrimitiveChoice& choice : choices)
            choice = within_memory(block.input, choice, options_.bytes_per_curve);
    return choices;
}

std::vector<BenchRun::Case> BenchRun::open_cases(Block& block) {
    std::vector<Case> open;
    for (size_t set = 0; set < axes_->rays.size(); ++set)
        for (size_t primitive = 0; primitive < axes_->primitives.size(); ++primitive) {
            const size_t number = axes_->number(block.model, block.resolution, set, primitive);
            if (!is_wanted(number)) continue;
            const std::string key = base_row(block, set, primitive).key();
            if (!seen_.insert(key).second) continue;  // a model or set that was named twice
            const auto row = finished_.find(key);
            if (row == finished_.end())
                open.push_back({set, primitive});
            else
                block.rows[number] = row->second;
        }
    return open;
}

ResultRow BenchRun::base_row(const Block& block, size_t set, size_t primitive) const {
    ResultRow row;
    row.sweep = {axes_, sweep_id_, axes_->number(block.model, block.resolution, set, primitive), shard_};
    row.model = block.facts;
    row.rays = block.ray_facts[set];
    row.device = facts_of(device_.info(), device_.has_validation());
    row.settings = {*options_.repeat,
                    warm_up_of(device_.info()),
                    options_.rays.error_rays,
                    options_.leaf_order,
                    !options_.no_compaction,
                    !options_.no_normals,
                    options_.low_memory,
                    options_.device.traversal,
                    options_.no_skips,
                    caps_,
                    options_.bytes_per_curve,
                    culling_.to_string(),
                    {}};
    row.seed = options_.rays.seed;
    row.context = context_;
    if (primitive == choices_.size()) return with_embree_facts(std::move(row));
    row.primitive = facts_of(choices_[primitive], caps_);
    return row;
}

void BenchRun::measure_set(Block& block, size_t set, const std::vector<const PreparedCase*>& group,
                           const PreparedCase* baseline) {
    const bool has_any = std::any_of(group.begin(), group.end(), [&](const PreparedCase* prepared) {
        return block.is_open(set, index_of(choices_, prepared->choice));
    });
    if (!has_any) return;
    const MeasuredRays& rays = block.rays.sets()[set];
    const std::unique_ptr<TracedRays> buffers = device_.upload(rays.rays, block.input.options.normals);
    std::vector<ResultRow> rows;  // of traced[i], but for a baseline that is there for its time alone
    std::vector<const PreparedCase*> traced;
    for (const PreparedCase* prepared : group) {
        const size_t primitive = index_of(choices_, prepared->choice);
        if (!block.is_open(set, primitive)) continue;
        prepared->traced->run(*buffers, rays.shadow);
        ResultRow row = base_row(block, set, primitive);
        row.geometry_ms = prepared->geometry_ms;
        if (block.input.culled != nullptr) {
            row.settings.left_out = block.input.culled->left_out();
            row.cull_ms = block.input.culled->milliseconds;
        }
        row.cost = prepared->traced->cost();
        {
            const Hits hits = buffers->hits();
            CaseErrors errors = errors_of(block.input, prepared->choice, rays, selected(hits, rays.sample));
            row.intersector_error = errors.own;
            row.model_error = errors.model;
            if (!is_within_limits(row)) continue;
            if (!options_.images.empty() && rays.is_picture) {
                row.images = write_pictures(block, *prepared, rays, hits);
                row.distances = block.distances[primitive];
            }
        }
        rows.push_back(std::move(row));
        traced.push_back(prepared);
    }
    if (traced.empty()) return;
    const auto place = std::find(traced.begin(), traced.end(), baseline);
    const auto baseline_place = static_cast<size_t>(place - traced.begin());
    if (place == traced.end() && baseline != nullptr) {
        baseline->traced->run(*buffers, rays.shadow);  // drivers compile at the first dispatch
        traced.push_back(baseline);
    }

    const std::vector<TimeSamples> samples = time_all(block, set, traced, *buffers);
    const std::string name = fmt::format("{} case {}", context_.time, rows.front().sweep.number);
    for (size_t i = 0; i < rows.size(); ++i) {
        ResultRow& row = rows[i];
        row.trace_ms = samples[i].device_ms;
        row.wall_ms = samples[i].wall_ms;
        row.positions = samples[i].positions;
        row.group = name;
        if (baseline != nullptr) row.ratio = ratio_to(samples[baseline_place], samples[i], baseline->choice);
        row.cost = traced[i]->traced->cost();  // the first rays may have chosen the traversal
        if (options_.profile) row.profile = profile_of(block.input, *traced[i]->traced, rays, row.seed);
        add(block, std::move(row));
    }
}

std::vector<TimeSamples> BenchRun::time_all(const Block& block, size_t set,
                                            const std::vector<const PreparedCase*>& traced,
                                            TracedRays& rays) const {
    const bool shadow = block.rays.sets()[set].shadow;
    std::vector<std::function<double()>> traces;
    for (const PreparedCase* prepared : traced)
        traces.emplace_back([&rays, prepared, shadow] { return prepared->traced->run(rays, shadow); });
    constexpr uint32_t fewest_rounds = 3;  // even when time is up: below that there is no spread
    return interleave(
        traces, {.rounds = block.input.samples,
                 .warm_up_ms = block.input.warm_up_ms,
                 .seed = Hash().add_number(options_.rays.seed).add_number(block.ray_facts[set].hash).value(),
                 .stop = [&](uint32_t done) { return done >= fewest_rounds && is_over_budget(); }});
}

void BenchRun::measure_embree(Block& block) {
    if (!with_embree_) return;
    for (const Case& one : block.open) {
        if (one.primitive != choices_.size() || is_over_budget()) continue;
        if (!block.scene.is_plain()) {
            inform("{}: no row for Embree, which is given single models only", block.scene.name);
            return;
        }
        ResultRow row =
            embree_row(block.input, block.rays.sets()[one.set], base_row(block, one.set, one.primitive));
        if (is_within_limits(row)) add(block, std::move(row));
    }
}

bool BenchRun::is_within_limits(const ResultRow& row) {
    const bool is_wrong =
        options_.max_error > 0 && row.model_error && !(ranking_error(*row.model_error) <= options_.max_error);
    const bool is_large = options_.max_memory > 0 && row.resident_bytes() &&
                          double(*row.resident_bytes()) > options_.max_memory;
    if (!is_wrong && !is_large) return true;
    inform("{}, {} rays: {} is left out, beyond {}", row.model.name, row.rays.name, row.primitive.label,
           is_wrong ? "--max-error" : "--max-memory");
    ++left_out_;
    return false;
}

void BenchRun::add(Block& block, ResultRow row) {
    row.reproduce = reproducing_command(options_, row);
    block.rows[row.sweep.number] = writer_->add(row);
}

}  // namespace strandlab
