// Every registered primitive against the contract of primitives/primitive.h: what it describes, what it
// builds, that its boxes hold its surface, and that its C++ text finds its own surface.
#include "conformance_scene.h"
#include "gpu/embedded_shaders.h"
#include "primitives/primitive.h"
#include "trace/reach_grid.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

namespace strandlab {
namespace {

class Contract : public testing::TestWithParam<std::string> {
  protected:
    const Primitive& primitive() const { return primitive_named(GetParam()); }
    PrimitiveChoice choice() const { return parse_primitive(GetParam()); }
    Geometry geometry(const Curves& curves) const { return primitive().build(curves, choice().options); }
};

TEST_P(Contract, DescribesItself) {
    EXPECT_FALSE(primitive().summary.empty());
    EXPECT_FALSE(primitive().caps.empty());
    for (const char c : primitive().name)
        EXPECT_TRUE(std::islower(static_cast<unsigned char>(c))) << primitive().name;
    EXPECT_NE(primitive().surface, nullptr) << "surface() is missing";
    EXPECT_NE(primitive().build, nullptr) << "build() is missing";
    EXPECT_NE(primitive().cpu.single, nullptr) << "the float version is missing";
    EXPECT_NE(primitive().cpu.precise, nullptr) << "the double version is missing";
}

TEST_P(Contract, ParametersHaveHelpAndDefaultsInRange) {
    std::set<std::string> names;
    for (const ParameterInfo& info : primitive().parameters) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name << " stands twice";
        EXPECT_FALSE(info.help.empty()) << info.name;
        Parameters parameters(primitive().parameters);
        EXPECT_NO_THROW(
            parameters.set(primitive().name, primitive().parameters, info.name, info.default_value))
            << info.name << "=" << info.default_value;
    }
}

TEST_P(Contract, ShadersAreEmbedded) {
    const PrimitiveShaders& shaders = primitive().shaders;
    EXPECT_FALSE(embedded_shader(shaders.closest_hit).empty()) << shaders.closest_hit << " is missing";
    if (!shaders.intersection.empty()) {
        EXPECT_FALSE(embedded_shader(shaders.intersection).empty()) << shaders.intersection << " is missing";
    }
    if (!shaders.any_hit.empty()) {
        EXPECT_FALSE(embedded_shader(shaders.any_hit).empty()) << shaders.any_hit << " is missing";
    }
}

TEST_P(Contract, LeavesCoverEveryCurve) {
    const Curves curves = conformance_curves();
    const Geometry g = geometry(curves);
    ASSERT_EQ(g.leaves.size(), g.is_triangles() ? g.triangles.size() : g.boxes.size());
    if (g.leaf_records.stride != 0) {
        EXPECT_EQ(g.leaf_records.size(), g.leaves.size());
    }
    std::vector<std::set<uint32_t>> pieces(curves.curves.size());
    for (size_t i = 0; i < g.leaves.size(); ++i) {
        const Leaf leaf = g.leaves[i];
        ASSERT_LT(leaf.curve, curves.curves.size());
        ASSERT_LT(leaf.piece(), leaf.pieces());
        pieces[leaf.curve].insert(leaf.piece());
        if (g.uniform_pieces != 0) {
            EXPECT_EQ(leaf.curve, i / g.uniform_pieces);
            EXPECT_EQ(leaf.piece(), i % g.uniform_pieces);
            EXPECT_EQ(leaf.pieces(), g.uniform_pieces);
        }
        pieces[leaf.curve].insert(leaf.piece());
    }
    for (size_t i = 0; i < g.leaves.size(); ++i)
        EXPECT_EQ(pieces[g.leaves[i].curve].size(), g.leaves[i].pieces()) << "curve " << g.leaves[i].curve;
}

TEST_P(Contract, BuildsTheSameTwiceAndNothingFromNothing) {
    const Curves curves = conformance_curves();
    const Geometry a = geometry(curves), b = geometry(curves);
    EXPECT_EQ(a.leaf_records.bytes, b.leaf_records.bytes);
    EXPECT_EQ(a.curve_records.bytes, b.curve_records.bytes);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.constants, b.constants);
    EXPECT_EQ(geometry(Curves{}).leaf_count(), 0u);
    EXPECT_TRUE(primitive().surface(Curves{}, choice().options).pieces.empty());
}

TEST_P(Contract, BoxesAreFiniteAndHoldTheirCurve) {
    const Curves curves = conformance_curves();
    const Geometry g = geometry(curves);
    const std::vector<Box> boxes = leaf_boxes(g);
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Leaf leaf = g.leaves[i];
        ASSERT_FALSE(boxes[i].is_empty()) << i;
        if (g.is_triangles()) continue;
        // The centre of the leaf's joints: on the surface's centre line for every primitive.
        for (const uint32_t end : {leaf.piece(), leaf.piece() + 1}) {
            const glm::dvec4 point =
                point_at(to_double(curves.curves[leaf.curve]), double(end) / leaf.pieces());
            const double slack = 1e-6;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(boxes[i].low[axis], point[axis] - point.w + slack) << "leaf " << i;
                EXPECT_GE(boxes[i].high[axis], point[axis] + point.w - slack) << "leaf " << i;
            }
        }
    }
}

/// The options by default, and with every word that a parameter can be.
std::vector<BuildOptions> all_words(const PrimitiveChoice& choice) {
    std::vector<BuildOptions> all{choice.options};
    for (const ParameterInfo& info : choice.primitive->parameters)
        for (const std::string& word : info.choices)
            all.emplace_back(choice.options)
                .parameters.set(choice.primitive->name, choice.primitive->parameters, info.name, word);
    return all;
}

/// What strands_within_reach (trace/reach.h) relies on.
TEST_P(Contract, LeavesStayNearTheirCurve) {
    const Curves curves = conformance_curves(100);
    for (const BuildOptions& options : all_words(choice())) {
        const Geometry g = primitive().build(curves, options);
        const std::vector<Box> boxes = leaf_boxes(g);
        for (size_t i = 0; i < boxes.size(); ++i) {
            const Box hull = hull_box({&curves.curves[g.leaves[i].curve], 1}, widest_primitive);
            const float slack = 2e-6f;  // of coordinates up to 2
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(boxes[i].low[axis], hull.low[axis] - slack) << "leaf " << i;
                EXPECT_LE(boxes[i].high[axis], hull.high[axis] + slack) << "leaf " << i;
            }
        }
    }
}

TEST_P(Contract, FindsItsOwnSurface) {
    if (primitive().diagnostic) GTEST_SKIP() << primitive().name << " hits nothing by design";
    const Curves curves = conformance_curves();
    const Geometry g = geometry(curves);
    const std::vector<Ray> rays = conformance_rays(curves);
    size_t hits = 0;
    for (const Ray& ray : rays) {
        LeafHit<float> best;
        double distance = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < g.leaf_count(); ++i) {
            LeafHit<float> hit;
            if (!primitive().cpu.single(g, i, ray, ray.tmax, hit)) continue;
            EXPECT_GE(hit.t, ray.tmin);
            EXPECT_GE(hit.u, 0.0f);
            EXPECT_LE(hit.u, 1.0f);
            EXPECT_NEAR(glm::length(hit.normal), 1.0f, 1e-4f);
            if (hit.t < distance) {
                distance = hit.t;
                best = hit;
            }
        }
        hits += distance < std::numeric_limits<double>::infinity() ? 1 : 0;
    }
    EXPECT_GT(hits, rays.size() / 3) << "rays aimed at the strands: the intersector must hit most of them";
}

TEST_P(Contract, AnyBitPatternIsAMissOrAFiniteHit) {
    const Curves curves = conformance_curves();
    const Geometry g = geometry(curves);
    Random random(7);
    const auto any_float = [&] {
        const uint32_t bits = random.bits();
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    };
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{{any_float(), any_float(), any_float()},
                      any_float(),
                      {any_float(), any_float(), any_float()},
                      any_float()};
        const size_t leaf = random.below(static_cast<uint32_t>(g.leaf_count()));
        LeafHit<float> hit;
        if (primitive().cpu.single(g, leaf, ray, ray.tmax, hit)) {
            EXPECT_TRUE(std::isfinite(hit.t) && std::isfinite(hit.u));
        }
        LeafHit<double> precise;
        if (primitive().cpu.precise(g, leaf, ray, double(ray.tmax), precise)) {
            EXPECT_TRUE(std::isfinite(precise.t) && std::isfinite(precise.u));
        }
    }
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Primitive& primitive : primitives()) all.push_back(primitive.name);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Primitives, Contract, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace strandlab
