// strandlab validate: every primitive against the oracle of its own surface, and against Embree.
#include "base/error.h"
#include "base/progress.h"
#include "commands/arguments.h"
#include "commands/bundled_models.h"
#include "commands/command.h"
#include "commands/embree_case.h"
#include "commands/ray_arguments.h"
#include "commands/stress_report.h"
#include "report/table.h"
#include "report/text_format.h"
#include "trace/cpu_trace.h"
#include "trace/embree_reference.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace strandlab {
namespace {

struct Options {
    ModelArguments models;
    PrimitiveArguments primitives;
    RayArguments rays;
    DeviceArguments device;
    bool no_embree = false;
};

/// Embree agrees with a surface of its own definition on at least this share of decisive rays, or differs
/// by its own fault.
constexpr double embree_agreement = 0.998;

/// p99 of ulp(t) / r over the reference's hits: no float t can be better.
double ulp_floor(const MeasuredRays& rays, const Reference& reference) {
    std::vector<double> floors;
    for (size_t i = 0; i < reference.hits.size(); ++i) {
        const ReferenceHit& hit = reference.hits[i];
        if (!hit.is_hit() || !(hit.radius > 0)) continue;
        const double length = glm::length(glm::dvec3(rays.sample_rays[i].direction));
        floors.push_back(float_ulp(hit.t) * length / hit.radius);
    }
    if (floors.empty()) return 0;
    const size_t rank = nearest_rank(0.99, floors.size());
    std::nth_element(floors.begin(), floors.begin() + rank, floors.end());
    return floors[rank];
}

/// One primitive on one ray set, judged.
struct Verdict {
    Comparison error;
    double allowed_distance = 0;
    Tolerance tolerance;
    std::optional<SecondOpinion> embree;
    IterationHistogram iterations;  // of the C++ float version; empty for closed forms and placed models

    uint64_t wrong() const {
        const Tally& t = error.decisive;
        return t.nan.count + t.false_hit.count + t.false_miss.count + t.wrong_strand.count +
               t.wrong_place.count;
    }
    double wrong_share() const {
        return error.decisive.rays == 0 ? 0 : double(wrong()) / double(error.decisive.rays);
    }
    bool holds() const {
        if (!tolerance.judged) return error.decisive.nan.count == 0;
        return wrong_share() <= tolerance.wrong && error.decisive.nan.count == 0 &&
               error.decisive.of(Measure::distance).p99 <= allowed_distance;
    }
    bool embree_holds() const {
        if (!embree || embree->rays == 0) return true;
        return double(embree->agree + embree->embree_wrong) / double(embree->rays) >= embree_agreement;
    }
};

Verdict judge(const CaseInput& input, const PreparedCase& prepared, const MeasuredRays& rays,
              bool with_embree) {
    const TraceResult trace =
        prepared.traced->trace(rays.rays, {.shadow = rays.shadow, .samples = 1, .warm_up_ms = 0});
    const Hits sample = selected(trace.hits, rays.sample);
    const std::vector<Surface> surfaces = own_surfaces(input.scene, prepared.choice);
    const Reference own = make_scene_reference(input.scene, surfaces, input.curves, rays.sample_rays);
    Verdict verdict;
    verdict.error = compare_with(input.scene, input.curves, rays, sample, own, false);
    const PrimitiveChoice& choice = prepared.choice;
    if (choice.primitive->tolerance != nullptr)
        verdict.tolerance = choice.primitive->tolerance(choice.options);
    verdict.allowed_distance = std::max(verdict.tolerance.distance_p99, 1.5 * ulp_floor(rays, own));
    if (input.scene.is_plain() && choice.primitive->cpu.counted != nullptr) {
        const Geometry geometry = choice.primitive->build(input.curves, choice.options);
        for (const RayWork& work : cpu_work(geometry, *choice.primitive, rays.sample_rays))
            verdict.iterations.add(work.iterations);
    }
    if (with_embree && input.scene.is_plain() && !rays.shadow)
        verdict.embree = second_opinion(input.curves, rays, sample, surfaces[0], own);
    return verdict;
}

std::vector<std::string> cells(const std::string& model, const std::string& rays, const std::string& label,
                               const Verdict& v) {
    const Tally& t = v.error.decisive;
    const Percentiles& distance = t.of(Measure::distance);
    std::vector<std::string> row = {model,
                                    rays,
                                    label,
                                    grouped(t.rays),
                                    percent(v.error.undecided_share()),
                                    std::to_string(t.false_hit.count),
                                    std::to_string(t.false_miss.count),
                                    std::to_string(t.wrong_strand.count),
                                    std::to_string(t.wrong_place.count),
                                    significant(distance.p50, 2),
                                    significant(distance.p99, 2),
                                    v.tolerance.judged ? significant(v.allowed_distance, 2) : "-",
                                    significant(t.of(Measure::normal).p99, 2),
                                    iterations_text(v.iterations)};
    if (v.embree && v.embree->rays > 0)
        row.insert(row.end(),
                   {significant(100 * v.embree->agreement(), 5), std::to_string(v.embree->embree_wrong),
                    std::to_string(v.embree->primitive_wrong), std::to_string(v.embree->both_wrong)});
    else
        row.insert(row.end(), 4, "-");
    row.push_back(!v.holds()            ? "FAILS"
                  : !v.tolerance.judged ? "not judged"
                  : !v.embree_holds()   ? "FAILS (Embree)"
                                        : "holds");
    return row;
}

/// Why a primitive is held to less, or to nothing.
std::string note_on(const PrimitiveChoice& choice, const Tolerance& tolerance) {
    if (!tolerance.judged)
        return fmt::format("{}: not judged but for NaN: {}\n", choice.label(), tolerance.reason);
    return fmt::format("{}: wrong on at most {} of decisive rays: {}\n", choice.label(),
                       percent(tolerance.wrong), tolerance.reason);
}

int run(Options& options) {
    if (options.models.models.empty()) options.models.models = bundled_models();
    if (options.rays.names.empty()) options.rays.names = {"primary", "secondary"};
    options.rays.check();
    const CurveOptions curve_options = options.models.curve_options();
    const std::vector<PrimitiveChoice> choices = options.primitives.choices();
    const Resolution size =
        parse_resolution(options.rays.resolution.empty() ? "320x180" : options.rays.resolution);
    const TraceDevice device(options.device.options());
    const bool with_embree = embree_available() && !options.no_embree;
    Table table({{"model", "", true},
                 {"rays", "", true},
                 {"primitive", "", true},
                 {"decisive", "rays"},
                 {"undecided"},
                 {"false hit"},
                 {"false miss"},
                 {"strand"},
                 {"place"},
                 {"dt p50", "radii"},
                 {"dt p99", "radii"},
                 {"allowed", "radii"},
                 {"normal p99", "deg"},
                 {"iterations", "mean / p99 / max"},
                 {"Embree agrees", "%"},
                 {"Embree wrong"},
                 {"ours wrong"},
                 {"both"},
                 {"verdict", "", true}},
                3);
    bool all_hold = true;
    std::string notes;
    for (const std::string& model : options.models.models) {
        const Scene scene = load_scene(model, curve_options);
        const Curves curves = all_curves(scene);
        if (curves.curves.empty()) continue;
        const RaySets rays(scene, curves, options.rays, size, options.primitives.scene_caps());
        CaseInput input{device, scene, curves, 1, 0, {}};
        input.options.normals = true;
        input.options.traversal = options.device.asked_traversal();
        input.options.ray_extent = object_extent(scene, rays.extent());
        Progress progress(scene.name, choices.size() * rays.sets().size());
        for (const PrimitiveChoice& choice : choices) {
            const PreparedCase prepared = prepare_case(input, choice);
            for (const MeasuredRays& set : rays.sets()) {
                const Verdict verdict = judge(input, prepared, set, with_embree);
                table.add_row(cells(scene.name, set.rays.name, choice.label(), verdict));
                all_hold &= verdict.holds() && (!verdict.tolerance.judged || verdict.embree_holds());
                if (!verdict.tolerance.reason.empty() &&
                    notes.find(choice.label() + ":") == std::string::npos)
                    notes += note_on(choice, verdict.tolerance);
                progress.tick();
            }
        }
    }
    device.check_validation();
    fmt::print("{}{}", table.to_string(standard_output_style()), notes);
    fmt::print(
        "Allowed: wrong on at most 0.01 % of decisive rays, dt p99 at most 0.001 radii or 1.5 times the p99 "
        "of\n"
        "ulp(t) / r, unless noted. Embree: counted where its definition applies; wrong says the oracle.\n");
    return static_cast<int>(all_hold ? ExitCode::ok : ExitCode::threshold);
}

}  // namespace

Command validate_command() {
    return {"validate", "every primitive against the oracle of its own surface and against Embree",
            "  strandlab validate\n"
            "  strandlab validate hair.hair --primitive prhi --primitive rocaps --rays secondary\n" +
                primitive_help(),
            [](CLI::App& app) -> RunCommand {
                auto options = std::make_shared<Options>();
                options->models.add_to(app, false);
                options->primitives.add_to(app, true);
                options->rays.add_to(app, "primary, secondary");
                options->device.add_to(app);
                app.add_flag("--no-embree", options->no_embree, "the oracle only");
                return [options] { return run(*options); };
            }};
}

}  // namespace strandlab
