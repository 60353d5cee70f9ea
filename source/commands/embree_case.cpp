#include "commands/embree_case.h"

#include "base/stopwatch.h"
#include "measure/ray_error.h"
#include "primitives/curved_pieces.h"
#include "report/case_images.h"
#include "trace/embree_reference.h"

namespace strandlab {

ResultRow with_embree_facts(ResultRow row) {
    row.primitive = {"embree", std::string(embree_label), {}, Caps::open, Caps::open};
    row.settings.cull.clear();  // it is given all strands
    row.device = {row.context.cpu, "Embree " + embree_version(), "none", "cpu", false,
                  false,           row.context.memory_bytes};
    return row;
}

ResultRow embree_row(const CaseInput& input, const MeasuredRays& rays, ResultRow row) {
    const Surface disc = curved_surface(input.scene.models[0], Surface::Sweep::disc, Caps::open);
    const Stopwatch stopwatch;
    const EmbreeScene scene(disc);
    row = with_embree_facts(std::move(row));
    SceneCost cost;
    cost.builds.build_ms = stopwatch.milliseconds();
    cost.builds.built_bytes = cost.builds.kept_bytes = scene.bytes();
    cost.leaf_count = disc.pieces.size();
    row.cost = cost;
    std::vector<Hit> hits(rays.rays.rays.size());
    scene.trace(rays.rays.rays, std::span<Hit>(hits));  // warms up
    for (uint32_t i = 0; i < input.samples; ++i) {
        const Stopwatch sample_stopwatch;
        scene.trace(rays.rays.rays, std::span<Hit>(hits));
        row.trace_ms.push_back(sample_stopwatch.milliseconds());
    }
    row.wall_ms = row.trace_ms;
    if (rays.sample.empty()) return row;
    std::vector<ReferenceHit> sample(rays.sample_rays.size());
    scene.trace(rays.sample_rays, std::span<ReferenceHit>(sample));
    const Hits sample_hits = hits_of(sample);
    const Reference own = make_scene_reference(input.scene, {&disc, 1}, input.curves, rays.sample_rays);
    row.intersector_error = compare_with(input.scene, input.curves, rays, sample_hits, own, false);
    row.model_error = compare_with(input.scene, input.curves, rays, sample_hits, rays.common, true, &own);
    return row;
}

SecondOpinion second_opinion(const Curves& curves, const MeasuredRays& rays, const Hits& sample_hits,
                             const Surface& surface, const Reference& reference) {
    const EmbreeScene embree(surface);
    std::vector<ReferenceHit> embree_hits(rays.sample_rays.size());
    embree.trace(rays.sample_rays, std::span<ReferenceHit>(embree_hits));
    const Hits other = hits_of(embree_hits);
    const auto input = [&](const Hits& hits, std::span<const ReferenceHit> against) {
        return ComparisonInput{
            .rays = rays.sample_rays, .hits = hits.hits, .reference = against, .curves = &curves};
    };
    const ComparisonInput ours_input = input(sample_hits, reference.hits),
                          embree_input = input(other, reference.hits),
                          between_input = input(sample_hits, embree_hits);
    const RayErrors ours(ours_input), theirs(embree_input), between(between_input);
    const EmbreeDefinition definition = embree_definition(surface);
    const auto fine = [](const RayError& error) {
        return error.outcome == Outcome::match || error.outcome == Outcome::agreed_miss;
    };
    SecondOpinion opinion;
    for (size_t i = 0; i < rays.sample_rays.size(); ++i) {
        const ReferenceHit& hit = reference.hits[i];
        // Its definition ends where the ray starts inside, or where strand ends are closed otherwise.
        if (!reference.decisive_place[i] || hit.starts_inside || (hit.on_cap && !definition.same_ends))
            continue;
        ++opinion.rays;
        const bool our_right = fine(ours.of(i)), their_right = fine(theirs.of(i));
        if ((our_right && their_right) || fine(between.of(i)))
            ++opinion.agree;
        else if (our_right)
            ++opinion.embree_wrong;
        else if (their_right)
            ++opinion.primitive_wrong;
        else
            ++opinion.both_wrong;
    }
    return opinion;
}

}  // namespace strandlab
