// Rays that leave hits, and boxes that must not lose them.
#include "measure/stress_spawn.h"

#include "measure/stress_limits.h"
#include "trace/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace strandlab {
namespace {

/// Everything about the pairs of one family for one primitive.
struct Case {
    PrimitiveChoice choice;
    StressRange range;
    Curves curves;
    Surface surface;
    Geometry geometry;
    StressPairs pairs;

    Case(const std::string& label, const StressFamily& family, uint64_t first, uint64_t count)
        : choice(parse_primitive(label)),
          range{&family, default_stress_seed, first, count},
          curves(stress_strands(range)),
          surface(choice.primitive->surface(curves, choice.options)),
          geometry(choice.primitive->build(curves, choice.options)),
          pairs(aimed_pairs(range, surface)) {}
    std::vector<SpawnPoint> points() const {
        return spawn_points(*choice.primitive, geometry, surface, pairs);
    }
};

/// STRANDLAB_LONG_TESTS=N: N pairs of every family and primitive instead of the few of a short run.
uint64_t pairs_or_long(uint64_t few) {
    const char* text = std::getenv("STRANDLAB_LONG_TESTS");
    return text == nullptr ? few : std::max<uint64_t>(few, std::strtoull(text, nullptr, 10));
}

TEST(SelfIntersection, RaysLeaveTheHitsOfEveryFamily) {
    for (const char* name : {"lss", "rocaps", "prhi", "dots"})
        for (const StressFamily& family : stress_families()) {
            if (!family.is_resolvable()) continue;
            const Case c(name, family, 0, pairs_or_long(150));
            SpawnTally tally;
            add_spawned(*c.choice.primitive, c.geometry, c.surface, c.range, c.points(), tally);
            const StressJudgement judgement = judge_spawned(tally, *c.choice.primitive, family);
            EXPECT_NE(judgement.verdict, StressVerdict::fails)
                << name << ", " << family.name << ": " << judgement.text;
            EXPECT_EQ(tally.shadow_differs, 0u) << name << ", " << family.name;
        }
}

TEST(SelfIntersection, IsSeenWhereRaysStartOnTheSurface) {
    // Strips are two-sided and start at the ray's own depth; within the solid everything is met again.
    const Case strips("dots", stress_family("gentle"), 0, 500);
    SpawnTally tally;
    add_spawned(*strips.choice.primitive, strips.geometry, strips.surface, strips.range, strips.points(),
                tally);
    EXPECT_GT(tally.unmoved, 20u);
    EXPECT_GT(tally.ulps_needed, 0.5);
    EXPECT_LT(tally.ulps_needed, strips.choice.primitive->spawn.ulps);

    // Points that are moved inwards by mistake.
    const Case cones("rocaps:variant=published", stress_family("curl"), 0, 500);
    std::vector<SpawnPoint> points = cones.points();
    for (SpawnPoint& point : points) point.place.point -= 0.3f * point.place.radius * point.place.normal;
    SpawnTally inside;
    add_spawned(*cones.choice.primitive, cones.geometry, cones.surface, cones.range, points, inside);
    EXPECT_GT(inside.self_hits, 20u);
    EXPECT_EQ(judge_spawned(inside, *cones.choice.primitive, *cones.range.family).verdict,
              StressVerdict::fails);
}

TEST(SelfIntersection, PointsLieOnTheSurface) {
    for (const char* name : {"lss", "rocaps", "prhi", "dots"}) {
        const Case c(name, stress_family("far 1e4"), 0, 400);
        const std::vector<Surface> parts = strand_surfaces(c.surface, c.range.count, 1);
        const std::vector<SpawnPoint> points = c.points();
        size_t usable = 0, met = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            if (!points[i].usable) continue;
            ++usable;
            // From a radius outside, straight back. Another part of the strand may be in the way.
            const SpawnPlace& place = points[i].place;
            Ray ray;
            ray.origin = place.point + place.normal * place.radius;
            ray.direction = -place.normal;
            const ReferenceHit hit = Oracle(parts[i]).trace(ray);
            met += hit.is_hit() && std::abs(hit.t - place.radius) < 0.01 * place.radius;
        }
        EXPECT_GT(usable, 250u) << name;
        EXPECT_GE(double(met), 0.97 * double(usable)) << name;
    }
}

TEST(SpawnOffset, IsTheLargerOfItsTwoTerms) {
    const SpawnOffset offset{0.01, 4};
    EXPECT_DOUBLE_EQ(offset.distance(2, 1), 0.02);
    EXPECT_DOUBLE_EQ(offset.distance(1e-9, 1), 4 * std::numeric_limits<float>::epsilon());
    for (const Primitive& primitive : primitives()) {
        EXPECT_GT(primitive.spawn.radii, 0) << primitive.name;
        EXPECT_GT(primitive.spawn.ulps, 0) << primitive.name;
    }
}

TEST(SpawnOrigin, LeavesBothStripsOfACross) {
    SpawnPlace place;
    place.normal = {0, 0, 1};
    place.aside = {0, 1, 0};
    place.across = 0.25f;
    EXPECT_EQ(spawn_origin(place, 0.125f), glm::vec3(0, 0, 0.125f));
    EXPECT_EQ(spawn_origin(place, 1.0f), glm::vec3(0, 0.75f, 1));
}

TEST(Boxes, LoseNoHit) {
    // 44 families and 4 primitives: STRANDLAB_LONG_TESTS=60000 makes it ten million pairs.
    for (const char* name : {"lss", "rocaps", "prhi", "dots"})
        for (const StressFamily& family : stress_families()) {
            BoxCheck boxes;
            uint64_t hits = 0;
            const uint64_t count = pairs_or_long(400);
            for (uint64_t first = 0; first < count; first += 20000) {
                const Case c(name, family, first, std::min<uint64_t>(20000, count - first));
                for (const Precision precision : {Precision::single, Precision::precise})
                    for (const StressHit& hit :
                         intersect_pairs(*c.choice.primitive, c.geometry, c.pairs, precision, boxes))
                        hits += hit.is_hit();
            }
            EXPECT_EQ(boxes.lost, 0u) << name << " " << family.name;
            if (unknown_places(*parse_primitive(name).primitive, family).empty()) {
                EXPECT_EQ(boxes.outside, 0u) << name << " " << family.name;
            }
            EXPECT_GE(boxes.trials, hits);
        }
}

TEST(Boxes, LosesAreSeen) {
    // Boxes that are a little too small lose hits, and hits lie outside of them.
    Case c("lss", stress_family("gentle"), 0, 500);
    for (Box& box : c.geometry.boxes) {
        const glm::vec3 size = box.high - box.low;
        box.low += 0.02f * size, box.high -= 0.02f * size;
    }
    BoxCheck boxes;
    intersect_pairs(*c.choice.primitive, c.geometry, c.pairs, Precision::single, boxes);
    EXPECT_GT(boxes.lost, 3u);
    EXPECT_GT(boxes.outside, boxes.lost);
}

}  // namespace
}  // namespace strandlab
