// How leaves are shared out when memory is limited.
#include "primitives/leaf_budget.h"

#include "measure/memory_budget.h"
#include "strands/generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace strandlab {
namespace {

Curves curves_of(const std::vector<Curve>& all) {
    Curves curves;
    curves.curves = all;
    curves.strands = {{0, static_cast<uint32_t>(all.size())}};
    return curves;
}

/// Along a diagonal of the given length.
Curve diagonal(float length) {
    Curve curve;
    for (int i = 0; i < 4; ++i) curve[i] = glm::vec4(glm::vec3(length * float(i) / 3.0f), 1e-4f);
    return curve;
}

uint64_t total(const std::vector<uint32_t>& pieces) {
    return std::accumulate(pieces.begin(), pieces.end(), uint64_t(0));
}

TEST(LeafBudget, IsNeverExceededAndLeastIsGiven) {
    const Curves curves = generate("generate:head,style=curly,strands=60,points=12");
    std::vector<uint32_t> least(curves.curves.size(), 1);
    for (size_t i = 0; i < least.size(); i += 7) least[i] = 4;
    uint64_t before = 0;
    for (const double leaves : {1.5, 2.0, 2.7, 4.0, 7.3, 16.0, 64.0}) {
        const std::vector<uint32_t> pieces = pieces_within(curves, least, {leaves, leaves});
        ASSERT_EQ(pieces.size(), least.size());
        EXPECT_LE(double(total(pieces)), leaves * double(least.size()));
        for (size_t i = 0; i < least.size(); ++i) EXPECT_GE(pieces[i], least[i]);
        EXPECT_GE(total(pieces), before);
        before = total(pieces);
    }
    EXPECT_EQ(pieces_within(curves, least, {1.0, 1.0}), least);  // less than least asks for
}

TEST(LeafBudget, GoesToWhereBoxesAreLargest) {
    const Curves curves = curves_of({diagonal(1), diagonal(0.01f), diagonal(1)});
    const std::vector<uint32_t> pieces = pieces_within(curves, {1, 1, 1}, {11, 0});
    EXPECT_GT(pieces[0], 4 * pieces[1]);
    EXPECT_EQ(pieces[0], pieces[2]);
}

TEST(LeafBudget, IsSharedEquallyAmongEqualCurves) {
    const Curves curves = curves_of(std::vector<Curve>(100, diagonal(0.1f)));
    const std::vector<uint32_t> least(100, 1);
    EXPECT_EQ(pieces_within(curves, least, {5.9, 6.2}), std::vector<uint32_t>(100, 6));
    // Without a table more leaves fit; without that offer, as many as fit.
    const std::vector<uint32_t> own = pieces_within(curves, least, {5.9, 0});
    EXPECT_LE(total(own), 590u);
    EXPECT_GE(total(own), 500u);
}

TEST(LeafBudget, LessSurfaceThanWithEqualCounts) {
    std::vector<Curve> all;
    for (int i = 1; i <= 50; ++i) all.push_back(diagonal(0.002f * float(i * i)));
    const Curves curves = curves_of(all);
    const std::vector<uint32_t> pieces = pieces_within(curves, std::vector<uint32_t>(50, 1), {4, 4});
    double own = 0, equal = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        own += box_surface(all[i], pieces[i]);
        equal += box_surface(all[i], 4);
    }
    EXPECT_LT(own, 0.8 * equal);
}

TEST(LeafBudget, SurvivesCurvesOfNothing) {
    const float nan = std::nanf("");
    Curve bad = diagonal(1);
    bad[1] = glm::vec4(nan);
    Curve infinite = diagonal(1);
    infinite[2] = glm::vec4(INFINITY);
    const Curves curves = curves_of({bad, infinite, Curve{}, diagonal(1)});
    const std::vector<uint32_t> pieces = pieces_within(curves, {1, 1, 1, 1}, {4, 0});
    EXPECT_EQ(pieces[0], 1u);
    EXPECT_EQ(pieces[2], 1u);
    EXPECT_GT(pieces[3], 4u);
    EXPECT_TRUE(pieces_within(Curves{}, {}, {4, 4}).empty());
}

TEST(LeafBudget, PrimitivesOfTheCubicFollowIt) {
    const Curves curves = generate("generate:head,style=curly,strands=20,points=8");
    for (const char* name : {"prhi", "rocaps", "null"}) {
        PrimitiveChoice choice = parse_primitive(name);
        choice.options.leaf_budget = {2.5, 0};
        const Geometry geometry = choice.primitive->build(curves, choice.options);
        EXPECT_LE(double(geometry.leaf_count()), 2.5 * double(curves.curves.size())) << name;
        EXPECT_GT(geometry.leaf_count(), 2 * curves.curves.size()) << name;
        EXPECT_EQ(geometry.uniform_pieces, 0u) << name;
    }
}

TEST(LeafBudget, NeedsAStructureToMeasure) {
    const TraceDevice device({.selector = "cpu-float"});
    const Scene scene = scene_of("few", generate("generate:fur,strands=20"));
    const Curves curves = all_curves(scene);
    const CaseInput input{device, scene, curves, 1, 0, {}};
    EXPECT_THROW(within_memory(input, parse_primitive("prhi"), 200), Error);
    EXPECT_EQ(within_memory(input, parse_primitive("lss"), 200).label(), "lss");  // no splits: as it is
}

}  // namespace
}  // namespace strandlab
