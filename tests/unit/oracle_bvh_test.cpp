// The hierarchy against plain loops: which items are visited, which hit of many is first.
#include "oracle_cases.h"
#include "trace/bvh.h"
#include "trace/oracle.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>

namespace strandlab {
namespace {

using namespace oracle_cases;

std::vector<Box> random_boxes(size_t n) {
    std::vector<Box> boxes(n);
    for (size_t i = 0; i < n; ++i) {
        Random random(31, 0, i);
        const glm::vec3 low(random.range(-10, 10), random.range(-10, 10), random.range(-10, 10));
        boxes[i] = {low, low + glm::vec3(random.uniform(), random.uniform(), random.uniform())};
        if (i % 7 == 0) boxes[i].high = boxes[i].low;  // a point
        if (i % 11 == 0) boxes[i] = boxes[0];          // many in the same place
    }
    return boxes;
}

BvhRay random_ray(size_t i) {
    Random random(32, 0, i);
    glm::dvec3 direction = random_direction(random);
    if (i % 3 == 0) direction[static_cast<int>(i / 3 % 3)] = 0;
    return {glm::dvec3(random.range(-15, 15), random.range(-15, 15), random.range(-15, 15)), direction, 0,
            i % 4 == 0 ? 10 : std::numeric_limits<double>::infinity()};
}

std::vector<uint32_t> visited(const Bvh& bvh, const BvhRay& ray) {
    std::vector<uint32_t> items;
    bvh.traverse(ray, [&](uint32_t item, double&) {
        items.push_back(item);
        return false;
    });
    return items;
}

/// Whether the ray passes well inside the box's slabs.
bool certainly_meets(const Box& box, const BvhRay& ray) {
    long double near = ray.tmin, far = ray.tmax;
    for (int i = 0; i < 3; ++i) {
        const long double a = (static_cast<long double>(box.low[i]) - ray.origin[i]) * ray.inv_direction[i];
        const long double b = (static_cast<long double>(box.high[i]) - ray.origin[i]) * ray.inv_direction[i];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near <= far;
}

TEST(OracleBvh, VisitsEveryBoxThatIsMetOnce) {
    const std::vector<Box> boxes = random_boxes(3000);
    const Bvh bvh(boxes);
    EXPECT_EQ(bvh.item_count(), boxes.size());
    for (size_t i = 0; i < count(300); ++i) {
        const BvhRay ray = random_ray(i);
        std::vector<uint32_t> items = visited(bvh, ray);
        std::sort(items.begin(), items.end());
        EXPECT_EQ(std::adjacent_find(items.begin(), items.end()), items.end());
        for (uint32_t k = 0; k < boxes.size(); ++k) {
            if (!certainly_meets(boxes[k], ray)) continue;
            EXPECT_TRUE(std::binary_search(items.begin(), items.end(), k)) << "ray " << i << " box " << k;
        }
    }
}

TEST(OracleBvh, DoesNotDependOnThreads) {
    const std::vector<Box> boxes = random_boxes(20000);
    const Bvh many(boxes);
    Bvh one;
    tbb::task_arena(1).execute([&] { one = Bvh(boxes); });
    for (size_t i = 0; i < 50; ++i) EXPECT_EQ(visited(many, random_ray(i)), visited(one, random_ray(i)));
}

TEST(OracleBvh, LeavesOutWhatIsNoBox) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Box> boxes = {Box{}, Box{glm::vec3(nan), glm::vec3(1)},
                                    Box{glm::vec3(0), glm::vec3(1)}};
    const Bvh bvh(boxes);
    EXPECT_EQ(visited(bvh, BvhRay({0.5, 0.5, -1}, {0, 0, 1}, 0, 1e30)), std::vector<uint32_t>{2});
    EXPECT_TRUE(visited(Bvh(std::span<const Box>{}), BvhRay({0, 0, 0}, {0, 0, 1}, 0, 1)).empty());
}

TEST(OracleBvh, FirstHitOfManyCurvesIsThatOfAllTried) {
    const size_t curves = 300;
    for (const Surface::Sweep sweep : {Surface::Sweep::sphere, Surface::Sweep::disc}) {
        Surface all;
        all.sweep = sweep;
        std::vector<Surface> single;
        for (size_t i = 0; i < curves; ++i) {
            Random random(33, 0, i);
            Curve curve = random_curve(static_cast<Family>(i % 3), random);
            const glm::vec3 shift(random.signed_unit(), random.signed_unit(), random.signed_unit());
            for (glm::vec4& p : curve) p += glm::vec4(shift, 0);
            SurfacePiece piece{
                curve, static_cast<uint32_t>(i), 0, 1, i % 2 == 0 && sweep == Surface::Sweep::sphere, true,
                true};
            all.pieces.push_back(piece);
            single.push_back(all);
            single.back().pieces = {piece};
        }
        const Oracle oracle(all);
        std::vector<std::unique_ptr<Oracle>> oracles;
        for (const Surface& surface : single) oracles.push_back(std::make_unique<Oracle>(surface));
        size_t hits = 0;
        for (size_t i = 0; i < count(300); ++i) {
            Random random(34, 0, i);
            const Ray ray = aimed_ray(all.pieces[random.below(curves)].control, random, random.range(0, 3));
            ReferenceHit best;
            bool starts_inside = false;
            for (const auto& one : oracles) {
                const ReferenceHit hit = one->trace(ray);
                starts_inside = starts_inside || hit.starts_inside;
                if (hit.is_hit() && hit.t < best.t) best = hit;
            }
            const ReferenceHit hit = oracle.trace(ray);
            EXPECT_EQ(hit.t, best.t);
            EXPECT_EQ(hit.curve, best.curve);
            EXPECT_EQ(hit.starts_inside, starts_inside);
            hits += hit.is_hit();
        }
        EXPECT_GT(hits, count(300) / 3);
    }
}

}  // namespace
}  // namespace strandlab
