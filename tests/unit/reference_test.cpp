// The short cuts of make_reference change nothing: which rays are decisive follows from three whole traces.
#include "trace/reference.h"

#include "oracle_cases.h"
#include "trace/coherent_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace strandlab {
namespace {

using namespace oracle_cases;

struct Tangle {
    Surface surface;
    Curves curves;
    std::vector<Ray> rays;
};

/// Curves of all families across each other, with rays from outside, from inside and from just beside.
Tangle tangle(Surface::Sweep sweep, Caps caps, uint64_t seed) {
    Tangle result;
    result.surface.sweep = sweep;
    result.surface.caps = caps;
    for (uint32_t i = 0; i < 60; ++i) {
        Random random(seed, 0, i);
        const Curve curve = random_curve(static_cast<Family>(random.below(6)), random);
        result.surface.pieces.push_back({curve, i, 0, 1, random.below(4) == 0, true, true});
        result.curves.curves.push_back(curve);
        result.curves.strands.push_back({i, 1});
        for (int k = 0; k < 20; ++k)
            result.rays.push_back(aimed_ray(curve, random, std::pow(10.0, random.range(-4, 1))));
    }
    return result;
}

TEST(MakeReference, ShortCutsChangeNothing) {
    const DecisiveMargin margin;
    const OracleOptions larger{1 + margin.radius, margin.ulps, margin.ends};
    const OracleOptions smaller{1 - margin.radius, margin.ulps, -margin.ends};
    size_t hits = 0, undecided = 0, inside = 0;
    for (const auto& [sweep, caps] : {std::pair(Surface::Sweep::sphere, Caps::round),
                                      {Surface::Sweep::sphere, Caps::open},
                                      {Surface::Sweep::disc, Caps::flat}})
        for (uint64_t seed = 0; seed < 2; ++seed) {
            const Tangle t = tangle(sweep, caps, seed);
            const Reference reference = make_reference(t.surface, t.curves, t.rays, margin);
            const Oracle oracle(t.surface, larger);
            for (size_t i = 0; i < t.rays.size(); ++i) {
                const ReferenceHit hit = oracle.trace(t.rays[i], OracleOptions{});
                const ReferenceHit outer = oracle.trace(t.rays[i]), inner = oracle.trace(t.rays[i], smaller);
                const Decided expected = decided(t.rays[i], t.curves, hit, outer, inner);
                ASSERT_EQ(reference.hits[i].t, hit.t) << seed << " " << i;
                ASSERT_EQ(reference.hits[i].curve, hit.curve) << seed << " " << i;
                ASSERT_EQ(reference.hits[i].starts_inside, hit.starts_inside) << seed << " " << i;
                ASSERT_EQ(reference.decisive[i] != 0, expected.strand) << seed << " " << i;
                ASSERT_EQ(reference.decisive_place[i] != 0, expected.place) << seed << " " << i;
                hits += hit.is_hit();
                undecided += !expected.strand;
                inside += hit.starts_inside;
            }
        }
    EXPECT_GT(hits, 500u);
    EXPECT_GT(undecided, 5u);
    EXPECT_GT(inside, 100u);
}

TEST(MakeReference, TellsTheMarginThatThinStrandsNeed) {
    Random random(5);
    Curve curve = random_curve(Family::gentle, random);
    for (glm::vec4& p : curve) p.w = 1e-3f;
    const auto margin_of = [&] {
        return relative_margin(surface_of(curve, Surface::Sweep::sphere, Caps::round));
    };
    EXPECT_EQ(margin_of(), 1e-3);
    for (glm::vec4& p : curve) p.w = 1e-6f;
    // 8 ulps of a size between 0.25 and 2.
    EXPECT_GT(margin_of(), 8 * 0x1p-25 / 1e-6 * 0.99);
    EXPECT_LT(margin_of(), 8 * 0x1p-23 / 1e-6 * 1.01);
    EXPECT_EQ(
        make_reference(surface_of(curve, Surface::Sweep::sphere, Caps::round), curves_of(curve), {}).margin,
        margin_of());
    for (glm::vec4& p : curve) p.w = 0;
    EXPECT_GT(margin_of(), 1e300) << "no radius, no margin that would do";
    EXPECT_EQ(relative_margin(Surface{}), 1e-3);
}

TEST(CoherentOrder, IsAPermutationWhateverTheRays) {
    std::vector<Ray> rays(10'000);
    for (size_t i = 0; i < rays.size(); ++i) {
        Random random(3, 0, i);
        rays[i].origin = {float(random.signed_unit()), float(random.signed_unit()), 0};
        if (i % 7 == 0) rays[i].origin.x = std::numeric_limits<float>::quiet_NaN();
        if (i % 11 == 0) rays[i].direction = glm::vec3(0);
        if (i % 13 == 0) rays[i].origin.y = -std::numeric_limits<float>::infinity();
    }
    std::vector<uint32_t> order = coherent_order(rays);
    EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
    std::sort(order.begin(), order.end());
    for (uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

}  // namespace
}  // namespace strandlab
