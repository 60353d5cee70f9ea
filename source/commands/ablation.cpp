#include "commands/ablation.h"

#include "commands/bench_presets.h"
#include "measure/bench_case.h"
#include "measure/interleave.h"
#include "measure/statistics.h"
#include "report/table.h"
#include "trace/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace strandlab {
namespace {

/// A scene with all skips, or with one forced off.
struct Variant {
    std::string off;  // empty: none
    PreparedCase prepared;
    Hits hits;
};

bool takes(const Variant& variant, std::string_view skip) {
    const std::vector<std::string>& taken = variant.prepared.traced->cost().skipped;
    return std::find(taken.begin(), taken.end(), skip) != taken.end();
}

/// The thinnest radius that is not 0: distances are told apart by a hundredth of it.
float thinnest(const Curves& curves) {
    float least = std::numeric_limits<float>::infinity();
    for (const Curve& curve : curves.curves)
        for (const glm::vec4& p : curve)
            if (p.w > 0) least = std::min(least, p.w);
    return least;
}

/// Rays whose answer differs by more than rounding: hit or miss, or the distance.
size_t differences(const Hits& a, const Hits& b, float radius) {
    size_t count = 0;
    for (size_t i = 0; i < a.hits.size(); ++i) {
        const bool both = a.hits[i].is_hit() && b.hits[i].is_hit();
        const float allowed = std::max(1e-2f * radius, 1e-6f * std::abs(a.hits[i].t));
        if (a.hits[i].is_hit() != b.hits[i].is_hit() ||
            (both && !(std::abs(a.hits[i].t - b.hits[i].t) <= allowed)))
            ++count;
    }
    return count;
}

std::vector<Variant> make_variants(CaseInput input, const PrimitiveChoice& choice, bool measure) {
    std::vector<Variant> variants;
    variants.push_back({"", prepare_case(input, choice), {}});
    for (const Skip& skip : skips()) {
        if (!measure || !takes(variants.front(), skip.name)) continue;
        input.options.no_skips = {std::string(skip.name)};
        variants.push_back({std::string(skip.name), prepare_case(input, choice), {}});
    }
    return variants;
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

std::vector<double> median_times(std::vector<Variant>& variants, const CaseInput& input,
                                 const MeasuredRays& rays, uint64_t seed) {
    const std::unique_ptr<TracedRays> buffers = input.device.upload(rays.rays, input.options.normals);
    std::vector<std::function<double()>> traces;
    for (Variant& variant : variants) {
        variant.prepared.traced->run(*buffers, rays.shadow);
        variant.hits = buffers->hits();
        traces.emplace_back(
            [&variant, &buffers, &rays] { return variant.prepared.traced->run(*buffers, rays.shadow); });
    }
    const auto samples =
        interleave(traces, {.rounds = input.samples, .warm_up_ms = input.warm_up_ms, .seed = seed});
    std::vector<double> times;
    for (const TimeSamples& one : samples) times.push_back(summarise(one.device_ms, seed).median);
    return times;
}

void measure_set(std::vector<Variant>& variants, const CaseInput& input, const MeasuredRays& rays,
                 const PrimitiveChoice& choice, uint64_t seed) {
    const std::vector<double> times = median_times(variants, input, rays, seed);
    Table table({{.heading = choice.label() + ", " + rays.rays.name, .text = true},
                 {"trace", "ms"},
                 {"time", "ratio"},
                 {"memory", "ratio"},
                 {"answers that differ", "rays"}});
    for (size_t i = 0; i < variants.size(); ++i)
        table.add_row(
            {i == 0 ? "all skips" : "without " + variants[i].off, fmt::format("{:.4g}", times[i]),
             fmt::format("{:.3f}", times[i] / times[0]),
             fmt::format("{:.3f}", double(variants[i].prepared.resident_bytes()) /
                                       double(variants[0].prepared.resident_bytes())),
             fmt::format("{}", differences(variants[0].hits, variants[i].hits, thinnest(input.curves)))});
    fmt::print("\n{}", table.to_string(standard_output_style()));
    std::fflush(stdout);
}

}  // namespace

void print_ablation(BenchOptions& options, bool measure) {
    const TraceDevice device(options.device.options());
    apply_preset(options, device.info());
    options.rays.error_rays = 0;
    const Caps caps = options.primitives.scene_caps();
    fmt::print("{}\n", device.name());
    for (const std::string& model : options.models.models) {
        const Scene scene = load_scene(model, options.models.curve_options());
        if (scene.curve_count() == 0) continue;
        const Curves curves = all_curves(scene);
        const RaySets rays(scene, curves, options.rays, options.resolutions().front(), caps);
        CaseInput input{device, scene, curves, *options.repeat, warm_up_of(device.info()), {}};
        options.apply_to(input.options);
        input.options.ray_extent = object_extent(scene, rays.extent());
        fmt::print("\n{}\n", scene.name);
        for (const PrimitiveChoice& choice : options.primitives.choices()) {
            std::vector<Variant> variants = make_variants(input, choice, measure);
            explain(variants.front(), choice);
            for (size_t set = 0; measure && set < rays.sets().size(); ++set)
                measure_set(variants, input, rays.sets()[set], choice, options.rays.seed);
        }
    }
    device.check_validation();
}

}  // namespace strandlab
