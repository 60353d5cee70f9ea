// Which strands rays may meet, and that leaving out the others changes nothing.
#include "trace/reach.h"

#include "support/culled_scenes.h"
#include "support/parallel_strands.h"
#include "trace/reach_grid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace strandlab {
namespace {

std::vector<uint8_t> reached(const Curves& curves, std::vector<Ray> rays) {
    return strands_within_reach(scene_of("", curves), rays).front();
}

using Marks = std::vector<uint8_t>;

TEST(Reach, StrandsThatRaysPassAreOut) {
    const Curves curves = parallel_strands(5);
    EXPECT_EQ(reached(curves, {{{1.2f, 2, 5}, 0, {0, 0, -2}, 1e30f}}), (Marks{0, 0, 1, 0, 0}));
    EXPECT_EQ(reached(curves, {{{1.2f, -3, 0}, 0, {0, 2, 0}, 2.2f}}), (Marks{1, 1, 0, 0, 0}));  // ends at 1.4
    EXPECT_EQ(reached(curves, {{{1.2f, -3, 0}, 2.2f, {0, 2, 0}, 1e30f}}), (Marks{0, 0, 1, 1, 1}));
    EXPECT_EQ(reached(curves, {{{1.2f, 2, 5}, 0, {0, 0, 2}, 1e30f}}), (Marks{0, 0, 0, 0, 0}));  // away
    EXPECT_EQ(reached(curves, {}), (Marks{0, 0, 0, 0, 0}));
}

TEST(Reach, AStrandGrazedAtItsRadiusIsIn) {
    const Curves curves = parallel_strands(3);
    for (const float offset : {0.1f, -0.1f}) {
        EXPECT_EQ(reached(curves, {{{1, 1 + offset, 5}, 0, {0, 0, -1}, 1e30f}}), (Marks{0, 1, 0})) << offset;
        EXPECT_EQ(reached(curves, {{{1e3f, 1 + offset, 0.1f}, 0, {-1, 0, 0}, 1e30f}}), (Marks{0, 1, 0}));
        EXPECT_EQ(reached(curves, {{{1, 5, offset}, 0, {0, -1, 0}, 3.5f}}), (Marks{0, 0, 1}));
    }
    EXPECT_EQ(reached(curves, {{{1, 1.4f, 5}, 0, {0, 0, -1}, 1e30f}}), (Marks{0, 0, 0}));
}

TEST(Reach, InvalidRaysMeetNothing) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(reached(parallel_strands(2), {{{nan, 0, 5}, 0, {0, 0, -1}, 1e30f},
                                            {{1, 0, 5}, 0, {0, infinity, -1}, 1e30f},
                                            {{1, 0, 5}, 0, {0, 0, 0}, 1e30f},
                                            {{1, 0, 5}, 7, {0, 0, -1}, 6},
                                            {{1, 0, 5}, 0, {0, 0, -1}, nan}}),
              (Marks{0, 0}));
}

TEST(Reach, WhatFloatsCannotBeTrustedWithReachesEverything) {
    const Curves curves = parallel_strands(3);
    EXPECT_EQ(reached(curves, {{{1, 1, 5}, 0, {0, 0, -1e-18f}, 1e30f}}), (Marks{1, 1, 1}));
    EXPECT_EQ(reached(curves, {{{1, 1, 5}, 0, {0, 0, -1e17f}, 1e30f}}), (Marks{1, 1, 1}));
    EXPECT_EQ(reached(curves, {{{1, 1e9f, 5}, 0, {0, 0, -1}, 1e30f}, {{1, 1, 5}, 0, {0, 0, -1}, 1e30f}}),
              (Marks{1, 1, 1}));  // 1e9 rounds to 64
    Scene flat = scene_of("", curves);
    flat.instances.front().world_from_object[2] = glm::vec3(0);
    const std::vector<Ray> ray{{{1, 1, 5}, 0, {0, 0, -1}, 1e30f}};
    EXPECT_EQ(strands_within_reach(flat, ray).front(), (Marks{1, 1, 1}));
}

TEST(Reach, EveryInstanceCounts) {
    Scene scene = scene_of("", parallel_strands(4));
    scene.instances.push_back({0, {glm::vec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}, {10, 0, 0}}});
    const std::vector<Ray> first{{{1, 1, 5}, 0, {0, 0, -1}, 1e30f}};
    const std::vector<Ray> second{{{11, -3, 5}, 0, {0, 0, -1}, 1e30f}};
    EXPECT_EQ(strands_within_reach(scene, first).front(), (Marks{0, 1, 0, 0}));
    EXPECT_EQ(strands_within_reach(scene, second).front(), (Marks{0, 0, 0, 1}));
    scene.instances.clear();
    EXPECT_EQ(strands_within_reach(scene, first).front(), (Marks{0, 0, 0, 0}));
}

/// Whether the ray enters the box between its tmin and tmax.
bool enters(const Ray& ray, const Box& box) {
    double near = double(ray.tmin), far = double(ray.tmax);
    for (int i = 0; i < 3; ++i) {
        const double origin = double(ray.origin[i]), direction = double(ray.direction[i]);
        const double low = double(box.low[i]) - origin, high = double(box.high[i]) - origin;
        if (direction == 0 && !(low <= 0 && high >= 0)) return false;
        if (direction == 0) continue;
        near = std::max(near, std::min(low / direction, high / direction));
        far = std::min(far, std::max(low / direction, high / direction));
    }
    return near <= far;
}

TEST(Reach, HoldsWhatAllPairsSayAndNotMuchMore) {
    const Curves curves = generate("generate:head,style=curly,strands=300,points=20");
    const Scene scene = scene_of("head", curves);
    for (const bool coherent : {false, true}) {
        std::vector<Ray> rays = testing::partial_rays(scene, 400, 0.2f).rays;
        if (coherent) {  // rows of a picture of a part
            rays.clear();
            const glm::vec3 middle(curves.curves[curves.curves.size() / 3][0]);
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 60; ++x)
                    rays.push_back({middle + glm::vec3(0, 0, 2), 0,
                                    glm::vec3(0.0005f * float(x), 0.0005f * float(y), -2), 1e30f});
        }
        const Marks marks = reached(curves, rays);
        size_t met = 0, kept = 0;
        for (size_t s = 0; s < curves.strands.size(); ++s) {
            bool is_met = false;
            for (uint32_t c = 0; c < curves.strands[s].count && !is_met; ++c) {
                const Box box = hull_box({&curves.curves[curves.strands[s].first + c], 1});
                is_met = std::any_of(rays.begin(), rays.end(),
                                     [&](const Ray& ray) { return is_valid(ray) && enters(ray, box); });
            }
            EXPECT_LE(is_met ? 1 : 0, marks[s]) << "strand " << s;
            met += is_met ? 1 : 0;
            kept += marks[s];
        }
        EXPECT_LT(met, curves.strands.size() * 9 / 10);
        EXPECT_LT(kept, met + (curves.strands.size() - met) / 2) << "of " << met;
    }
}

TEST(Reach, DoesNotDependOnThreads) {
    const Scene scene = testing::moved_scene();
    const Rays rays = testing::partial_rays(scene, 2000, 0.3f);
    const auto many = strands_within_reach(scene, rays.rays);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(strands_within_reach(scene, rays.rays), many);
}

class ReachAnswers : public ::testing::TestWithParam<const char*> {};

TEST_P(ReachAnswers, StayTheSame) {
    const TraceDevice device({.selector = "cpu-float"});
    const Scene scene = testing::moved_scene();
    testing::expect_same_answers(device, scene, testing::partial_rays(scene, 3000, 0.1f),
                                 parse_primitive(GetParam()));
    const Scene plain = scene_of("head", generate("generate:head,style=curly,strands=300,points=20"));
    testing::expect_same_answers(device, plain, testing::partial_rays(plain, 3000, 0.1f),
                                 parse_primitive(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Primitives, ReachAnswers,
                         ::testing::Values("null", "dots", "dots:tolerance=0.3", "lss", "lss:tolerance=0.3",
                                           "prhi:splits=4", "rocaps:splits=3"),
                         testing::name_of_choice);

}  // namespace
}  // namespace strandlab
