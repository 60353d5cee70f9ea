#include "commands/ablation.h"

#include "base/process_age.h"
#include "base/stopwatch.h"
#include "commands/bench_presets.h"
#include "measure/bench_case.h"
#include "measure/interleave.h"
#include "measure/statistics.h"
#include "primitives/curved_pieces.h"
#include "report/table.h"
#include "trace/culling.h"
#include "trace/embree_reference.h"
#include "trace/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <optional>

namespace strandlab {
namespace {

/// Host times of what comes before a scene is put on the device.
struct StartTimes {
    double device_ms = 0;  // with the loading of the program
    double model_ms = 0, rays_ms = 0;
};

/// A scene with everything that makes it fast, or with one thing forced off.
struct Variant {
    std::string name;
    PreparedCase prepared;
    std::vector<std::string> taken;  // skips
    double cull_ms = 0;
    Hits hits = {};

    /// Host and device time from curves to a scene that can be traced, but for the pipeline.
    double ready_ms() const {
        const SceneCost& cost = prepared.traced->cost();
        return cull_ms + prepared.geometry_ms + cost.order_ms + cost.builds.upload_ms + cost.builds.build_ms +
               cost.builds.compaction_ms;
    }
};

Variant make_variant(std::string name, const CaseInput& input, const PrimitiveChoice& choice) {
    Variant variant{std::move(name), prepare_case(input, choice), {}, 0, {}};
    variant.taken = variant.prepared.traced->cost().skipped;
    if (input.culled == nullptr) return variant;
    variant.cull_ms = input.culled->milliseconds;
    if (input.culled->out_of_reach.strands > 0) variant.taken.emplace_back(reach_skip);
    if (input.culled->too_small.strands > 0) variant.taken.emplace_back(detail_skip);
    return variant;
}

bool takes(const Variant& variant, std::string_view skip) {
    return std::find(variant.taken.begin(), variant.taken.end(), skip) != variant.taken.end();
}

/// The thinnest radius that is not 0: distances are told apart by a hundredth of it.
float thinnest(const Curves& curves) {
    float least = std::numeric_limits<float>::infinity();
    for (const Curve& curve : curves.curves)
        for (const glm::vec4& p : curve)
            if (p.w > 0) least = std::min(least, p.w);
    return least;
}

/// How many rays have another answer.
struct Differences {
    size_t answers = 0;  // by more than rounding: hit or miss, the strand, or the distance
    size_t bits = 0;     // by anything at all
};

Differences differences(const Hits& a, const Hits& b, const Curves& curves) {
    Differences count;
    const float radius = thinnest(curves);
    for (size_t i = 0; i < a.hits.size(); ++i) {
        const Hit &one = a.hits[i], &other = b.hits[i];
        if (std::memcmp(&one, &other, sizeof one) == 0) continue;
        ++count.bits;
        const bool both = one.is_hit() && other.is_hit();
        const float allowed = std::max(1e-2f * radius, 1e-6f * std::abs(one.t));
        const bool same_strand = both && one.instance == other.instance &&
                                 curves.strand_of(one.curve) == curves.strand_of(other.curve);
        if (one.is_hit() != other.is_hit() ||
            (both && !(same_strand && std::abs(one.t - other.t) <= allowed)))
            ++count.answers;
    }
    return count;
}

/// Of shadow rays, whose records say only whether there is a hit.
Differences shadow_differences(const Hits& a, const Hits& b) {
    Differences count;
    for (size_t i = 0; i < a.hits.size(); ++i)
        if (a.hits[i].is_hit() != b.hits[i].is_hit()) ++count.answers;
    count.bits = count.answers;
    return count;
}

/// The scene without one part of the culling.
Variant make_culling_variant(std::string_view skip, const CaseInput& input, const PrimitiveChoice& choice,
                             Culling culling, const Rays& rays) {
    if (skip == reach_skip) culling.reach = false;
    if (skip == detail_skip) culling.detail = 0;
    CaseInput other = input;
    std::optional<CulledScene> culled;
    if (culling.is_any()) culled = cull(input.scene, culling, rays.rays);
    other.culled = culled ? &*culled : nullptr;
    return make_variant("without " + std::string(skip), other, choice);
}

std::vector<Variant> make_variants(const CaseInput& input, const PrimitiveChoice& choice,
                                   const Culling& culling, const Rays& rays, bool measure) {
    std::vector<Variant> variants;
    variants.push_back(make_variant("as it is", input, choice));
    if (!measure) return variants;
    CaseInput other = input;
    for (const Skip& skip : skips()) {
        if (!takes(variants.front(), skip.name)) continue;
        if (skip.name == reach_skip || skip.name == detail_skip) {
            variants.push_back(make_culling_variant(skip.name, input, choice, culling, rays));
            continue;
        }
        other.options.no_skips = {std::string(skip.name)};
        variants.push_back(make_variant("without " + std::string(skip.name), other, choice));
    }
    if (input.device.gpu() != nullptr && GpuScene::reorders(input.device.info(), input.options)) {
        other.options = input.options;
        other.options.order = SceneOptions::Order::as_built;
        variants.push_back(make_variant("leaves in file order", other, choice));
    }
    return variants;
}

/// Embree's round curves on the same curves; nothing where its times have nothing to do with the device's: on
/// another processor, and for shadow rays, or where a scene has instances.
std::unique_ptr<EmbreeScene> embree_beside(const CaseInput& input) {
    if (!embree_available() || input.device.info().kind != "cpu" || !input.scene.is_plain()) return nullptr;
    return std::make_unique<EmbreeScene>(
        curved_surface(input.scene.models[0], Surface::Sweep::disc, Caps::open));
}

void explain_culling(const CulledScene& culled, const Scene& scene, const Rays& rays) {
    const StrandCount reach = culled.out_of_reach, small = culled.too_small;
    fmt::print(
        "\n{} rays: of {} strands ({} curves) {} ({}) are out of reach and {} ({}) too small; found in "
        "{:.1f} ms\n",
        rays.name, scene.strand_count(), scene.curve_count(), reach.strands, reach.curves, small.strands,
        small.curves, culled.milliseconds);
}

void explain(const Variant& all, const PrimitiveChoice& choice) {
    Table table({{.heading = choice.label(), .text = true},
                 {.heading = "taken", .text = true},
                 {.heading = "leaves out", .text = true},
                 {.heading = "where", .text = true}});
    for (const Skip& skip : skips())
        table.add_row({std::string(skip.name), takes(all, skip.name) ? "yes" : "no",
                       std::string(skip.leaves_out), std::string(skip.where)});
    fmt::print("\n{}", table.to_string(standard_output_style()));
}

/// What came before the first ray of the program could return, the first time.
void explain_start(const Variant& all, const CaseInput& input, const StartTimes& start, const Rays& rays) {
    Rays one;
    one.rays.assign(rays.rays.begin(), rays.rays.begin() + std::min<ptrdiff_t>(1, std::ssize(rays.rays)));
    const std::unique_ptr<TracedRays> buffers = input.device.upload(one, input.options.normals);
    const Stopwatch stopwatch;
    all.prepared.traced->run(*buffers, false);
    const double trace_ms = stopwatch.milliseconds(), total = process_age_ms();
    const SceneCost& cost = all.prepared.traced->cost();
    fmt::print(
        "start to first ray: {:.0f} ms: loading and opening the device {:.0f}, model {:.1f}, rays {:.1f}, "
        "boxes and "
        "records {:.1f}, order {:.1f}{}, upload {:.1f}, build {:.1f}, pipeline {:.1f}, first ray {:.1f}\n",
        total, start.device_ms, start.model_ms, start.rays_ms, all.prepared.geometry_ms, cost.order_ms,
        cost.order_cached ? " (kept from an earlier run)" : "", cost.builds.upload_ms, cost.builds.build_ms,
        cost.pipeline_ms, trace_ms);
    fmt::print("traversal: {}", name_of(cost.traversal));
    if (cost.traversal_times)
        fmt::print(" (measured: pipeline {:.3g} ms, query {:.3g} ms)", cost.traversal_times->pipeline_ms,
                   cost.traversal_times->query_ms);
    fmt::print("\n");
}

/// Medians over the rounds.
struct MedianTimes {
    double device_ms = 0;
    /// Of all threads of the program together: on a processor that others use as well, what can be compared.
    double processor_ms = 0;
};

double processor_ms() { return 1e3 * double(std::clock()) / double(CLOCKS_PER_SEC); }

/// Of the variants and, last, of Embree where there is one.
std::vector<MedianTimes> median_times(std::vector<Variant>& variants, const EmbreeScene* embree,
                                      const CaseInput& input, const MeasuredRays& rays, uint64_t seed) {
    const std::unique_ptr<TracedRays> buffers = input.device.upload(rays.rays, input.options.normals);
    std::vector<std::function<double()>> traces;
    for (Variant& variant : variants) {
        variant.prepared.traced->run(*buffers, rays.shadow);
        variant.hits = buffers->hits();
        traces.emplace_back(
            [&variant, &buffers, &rays] { return variant.prepared.traced->run(*buffers, rays.shadow); });
    }
    std::vector<Hit> embree_hits(rays.rays.rays.size());
    if (embree != nullptr)
        traces.emplace_back([&] {
            const Stopwatch stopwatch;
            embree->trace(rays.rays.rays, std::span<Hit>(embree_hits));
            return stopwatch.milliseconds();
        });
    std::vector<std::vector<double>> processor(traces.size());
    std::vector<std::function<double()>> watched;
    for (size_t i = 0; i < traces.size(); ++i)
        watched.emplace_back([&, i] {
            const double before = processor_ms(), device = traces[i]();
            processor[i].push_back(processor_ms() - before);
            return device;
        });
    const auto samples =
        interleave(watched, {.rounds = input.samples, .warm_up_ms = input.warm_up_ms, .seed = seed});
    std::vector<MedianTimes> times;
    for (size_t i = 0; i < traces.size(); ++i)
        times.push_back({summarise(samples[i].device_ms, seed).median, summarise(processor[i], seed).median});
    return times;
}

void measure_set(std::vector<Variant>& variants, const EmbreeScene* embree, const CaseInput& input,
                 const MeasuredRays& rays, const PrimitiveChoice& choice, uint64_t seed) {
    const std::vector<MedianTimes> times = median_times(variants, embree, input, rays, seed);
    const bool on_processor = input.device.info().kind == "cpu";
    std::vector<Column> columns{{.heading = choice.label() + ", " + rays.rays.name, .text = true},
                                {"trace", "ms"},
                                {"time", "ratio"}};
    if (on_processor) columns.insert(columns.end(), {{"processor", "ms"}, {"processor", "ratio"}});
    columns.insert(columns.end(), {{"ready", "ms"},
                                   {"memory", "ratio"},
                                   {"answers that differ", "rays"},
                                   {"bits that differ", "rays"}});
    Table table(columns);
    const auto time_cells = [&](const std::string& name, size_t i) {
        std::vector<std::string> cells{name, fmt::format("{:.4g}", times[i].device_ms),
                                       fmt::format("{:.3f}", times[i].device_ms / times[0].device_ms)};
        if (on_processor)
            cells.insert(cells.end(), {fmt::format("{:.4g}", times[i].processor_ms),
                                       fmt::format("{:.3f}", times[i].processor_ms / times[0].processor_ms)});
        return cells;
    };
    for (size_t i = 0; i < variants.size(); ++i) {
        std::vector<std::string> cells = time_cells(variants[i].name, i);
        cells.push_back(fmt::format("{:.4g}", variants[i].ready_ms()));
        cells.push_back(fmt::format("{:.3f}", double(variants[i].prepared.resident_bytes()) /
                                                  double(variants[0].prepared.resident_bytes())));
        const Differences count = rays.shadow ? shadow_differences(variants[0].hits, variants[i].hits)
                                              : differences(variants[0].hits, variants[i].hits, input.curves);
        cells.push_back(fmt::format("{}", count.answers));
        cells.push_back(fmt::format("{}", count.bits));
        table.add_row(std::move(cells));
    }
    if (embree != nullptr) {
        std::vector<std::string> cells = time_cells("Embree's round curves", variants.size());
        cells.insert(cells.end(), {"-", "-", "-", "-"});  // of another surface
        table.add_row(std::move(cells));
    }
    fmt::print("\n{}", table.to_string(standard_output_style()));
    std::fflush(stdout);
}

}  // namespace

void print_ablation(BenchOptions& options, bool measure) {
    const TraceDevice device(options.device.options());
    StartTimes start{.device_ms = process_age_ms()};
    apply_preset(options, device.info());
    options.rays.error_rays = 0;
    const Caps caps = options.primitives.scene_caps();
    const Culling culling = options.culling();
    fmt::print("{}\n", device.name());
    bool is_first = true;
    for (const std::string& model : options.models.models) {
        const Stopwatch model_stopwatch;
        const Scene scene = load_scene(model, options.models.curve_options());
        if (scene.curve_count() == 0) continue;
        const Curves curves = all_curves(scene);
        start.model_ms = model_stopwatch.milliseconds();
        const Stopwatch rays_stopwatch;
        const RaySets rays(scene, curves, options.rays, options.resolutions().front(), caps);
        start.rays_ms = rays_stopwatch.milliseconds();
        CaseInput input{device, scene, curves, *options.repeat, warm_up_of(device.info()), {}};
        options.apply_to(input.options);
        input.options.ray_extent = object_extent(scene, rays.extent());
        fmt::print("\n{}\n", scene.name);
        for (const PrimitiveChoice& choice : options.primitives.choices()) {
            const std::unique_ptr<EmbreeScene> embree =
                measure && !options.no_embree ? embree_beside(input) : nullptr;
            std::vector<Variant> variants;
            for (size_t set = 0; set < rays.sets().size(); ++set) {
                const MeasuredRays& one = rays.sets()[set];
                // What may be left out depends on the set alone, as in bench.
                if (set == 0 || culling.is_any()) {
                    std::optional<CulledScene> culled;
                    if (culling.is_any()) culled = cull(scene, culling, one.rays.rays);
                    input.culled = culled ? &*culled : nullptr;
                    variants = make_variants(input, choice, culling, one.rays, measure);
                    if (is_first) explain_start(variants.front(), input, start, one.rays);
                    is_first = false;
                    if (culled) explain_culling(*culled, scene, one.rays);
                    explain(variants.front(), choice);
                    input.culled = nullptr;
                }
                if (measure)
                    measure_set(variants, one.shadow ? nullptr : embree.get(), input, one, choice,
                                options.rays.seed);
            }
        }
    }
    device.check_validation();
}

}  // namespace strandlab
