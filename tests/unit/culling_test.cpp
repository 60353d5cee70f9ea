// What --cull reads, leaves out, and calls the curves that stay.
#include "trace/culling.h"

#include "base/error.h"
#include "support/culled_scenes.h"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

/// Strands of two curves along x of the given lengths, one below the other.
Curves strands_of_lengths(const std::vector<float>& lengths) {
    Curves curves;
    for (size_t s = 0; s < lengths.size(); ++s) {
        curves.strands.push_back({static_cast<uint32_t>(2 * s), 2});
        for (int c = 0; c < 2; ++c) {
            Curve curve;
            for (int k = 0; k < 4; ++k)
                curve[k] = glm::vec4(lengths[s] * float(3 * c + k) / 6, float(s), 0.0f, 0.001f);
            curves.curves.push_back(curve);
        }
    }
    return curves;
}

TEST(Culling, ReadsWhatItWrites) {
    for (const char* text : {"", "reach", "detail=0.001", "reach,detail=2.5"})
        EXPECT_EQ(parse_culling(text).to_string(), text);
    EXPECT_EQ(parse_culling("detail=1e-3,reach").to_string(), "reach,detail=0.001");
    EXPECT_FALSE(parse_culling("").is_any());
    for (const char* text : {"detail", "detail=", "detail=0", "detail=-1", "detail=nan", "detail=inf",
                             "detail=1e99", "detail=1x", "all", "reach,all"})
        EXPECT_THROW(parse_culling(text), Error) << text;
}

TEST(Culling, LeavesOutStrandsBelowTheTolerance) {
    const Scene scene = scene_of("", strands_of_lengths({1, 0.01f, 0.5f, 0.02f, 2}));
    const CulledScene culled = cull(scene, {.detail = 0.1f}, {});
    EXPECT_EQ(culled.too_small.strands, 2u);
    EXPECT_EQ(culled.too_small.curves, 4u);
    EXPECT_EQ(culled.out_of_reach.strands, 0u);
    EXPECT_EQ(*culled.curve_numbers, (std::vector<uint32_t>{0, 1, 4, 5, 8, 9}));
    EXPECT_EQ(culled.is_too_small, (std::vector<uint8_t>{0, 0, 1, 1, 0, 0, 1, 1, 0, 0}));
    const Curves& kept = culled.scene.models.front();
    ASSERT_EQ(kept.strands.size(), 5u);
    EXPECT_EQ(kept.strands[1].count, 0u);
    EXPECT_EQ(kept.strands[2].first, 2u);
    EXPECT_EQ(kept.strands[2].count, 2u);
    for (const uint32_t curve : {0u, 2u, 4u}) {
        EXPECT_EQ(kept.strand_of(curve), curve);
        EXPECT_TRUE(kept.begins_strand(curve) && kept.ends_strand(curve + 1));
    }
    EXPECT_EQ(kept.curves[3], scene.models.front().curves[5]);
}

TEST(Culling, AStretchedInstanceNeedsItsDetail) {
    Scene scene = scene_of("", strands_of_lengths({1, 0.01f}));
    scene.instances.push_back({0, {glm::vec3(0, 20, 0), {1, 0, 0}, {0, 0, 1}, {0, 0, 0}}});
    EXPECT_EQ(cull(scene, {.detail = 0.1f}, {}).too_small.strands, 0u);
    EXPECT_EQ(cull(scene, {.detail = 0.5f}, {}).too_small.strands, 1u);
}

TEST(Culling, NumbersCurvesThroughAllModels) {
    Scene scene = scene_of("", strands_of_lengths({0.01f, 1}));
    scene.models.push_back(strands_of_lengths({1, 0.01f, 1}));
    scene.instances.push_back({1});
    const CulledScene culled = cull(scene, {.detail = 0.1f}, {});
    EXPECT_EQ(*culled.curve_numbers, (std::vector<uint32_t>{2, 3, 4, 5, 8, 9}));
    EXPECT_EQ(culled.left_out().strands, 2u);
}

TEST(Culling, BothTogetherCountEachStrandOnce) {
    const Scene scene = scene_of("", strands_of_lengths({1, 0.01f, 1}));
    const std::vector<Ray> rays{{{0.5f, 0, 1}, 0, {0, 0, -1}, 1e30f}};
    const CulledScene culled = cull(scene, {.reach = true, .detail = 0.1f}, rays);
    EXPECT_EQ(culled.too_small.strands, 1u);
    EXPECT_EQ(culled.out_of_reach.strands, 1u);
    EXPECT_EQ(*culled.curve_numbers, (std::vector<uint32_t>{0, 1}));
}

/// Rays down onto the middle of every strand.
MeasuredRays rays_onto(const Scene& scene, const std::vector<Surface>& common, const Curves& curves) {
    MeasuredRays rays;
    for (const StrandRange& strand : curves.strands) {
        const glm::vec3 middle(curves.curves[strand.first][3]);
        rays.rays.rays.push_back({middle + glm::vec3(0, 0, 1), 0, {0, 0, -1}, 1e30f});
    }
    rays.sample = error_sample(rays.rays.rays.size(), 1000);
    rays.sample_rays = selected(rays.rays, rays.sample);
    rays.common = make_scene_reference(scene, common, curves, rays.sample_rays);
    return rays;
}

TEST(Culling, MissingDetailIsAnErrorOfTheModelNotOfTheIntersector) {
    const TraceDevice device({.selector = "cpu-float"});
    const Scene scene = scene_of("", strands_of_lengths({1, 0.01f, 0.5f, 0.02f, 2}));
    const Curves curves = all_curves(scene);
    const MeasuredRays rays = rays_onto(scene, common_surfaces(scene, Caps::round), curves);
    const CulledScene culled = cull(scene, {.detail = 0.1f}, {});
    CaseInput input{device, scene, curves, 1, 0, {.ray_extent = 5}};
    input.culled = &culled;
    for (const char* name : {"dots", "lss", "prhi", "rocaps"}) {
        const PrimitiveChoice choice = parse_primitive(name);
        const PreparedCase prepared = prepare_case(input, choice);
        const Hits hits = prepared.traced->trace(rays.rays, {}).hits;
        const CaseErrors errors = errors_of(input, choice, rays, selected(hits, rays.sample));
        EXPECT_EQ(errors.model->all.false_miss.count, 2u) << name;
        EXPECT_EQ(errors.own->all.false_miss.count, 0u) << name;
        EXPECT_EQ(errors.own->all.wrong_strand.count, 0u) << name;
        EXPECT_EQ(errors.model->all.wrong_strand.count, 0u) << name;
        EXPECT_EQ(hits.hits[4].curve, 8u) << name;
    }
}

TEST(Culling, WithNothingLeftEveryRayMisses) {
    const TraceDevice device({.selector = "cpu-float"});
    const Scene scene = scene_of("", strands_of_lengths({1, 2}));
    const Curves curves = all_curves(scene);
    const CulledScene culled = cull(scene, {.reach = true}, {});
    EXPECT_EQ(culled.left_out().strands, 2u);
    CaseInput input{device, scene, curves};
    input.culled = &culled;
    Rays rays;
    rays.rays = {{{0.5f, 0, 1}, 0, {0, 0, -1}, 1e30f}};
    const PreparedCase prepared = prepare_case(input, parse_primitive("prhi"));
    EXPECT_FALSE(prepared.traced->trace(rays, {}).hits.hits.front().is_hit());
}

}  // namespace
}  // namespace strandlab
