// Models that grow on the device answer rays as those that are made on the host.
#include "trace/grown_model.h"

#include "base/random.h"
#include "gpu_fixture.h"
#include "scene/bounds.h"
#include "strands/bezier.h"
#include "unit/hair_mesh_models.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

using GrownModelTest = GpuTest;
using testing_tools::bundled_mesh;
using testing_tools::style_with;

constexpr float ray_extent = 2;

/// Rays from a sphere of a metre about the head into its hair: not at joints of curves, where neighbours tie.
Rays rays_into(const Curves& curves, size_t count) {
    Rays rays;
    for (size_t i = 0; i < count; ++i) {
        Random random(9, 0, i);
        const Curve& curve = curves.curves[random.below(static_cast<uint32_t>(curves.curves.size()))];
        const glm::vec3 target(point_at(to_double(curve), 0.37));
        const glm::vec3 from = glm::normalize(glm::vec3(
            float(random.signed_unit()), float(random.signed_unit()), float(random.signed_unit()) + 0.01f));
        rays.rays.push_back({from, 0, target - from, std::numeric_limits<float>::infinity()});
    }
    return rays;
}

TEST_F(GrownModelTest, AnswersRaysAsTheHostsDoes) {
    const std::pair<const char*, const char*> cases[] = {
        {"bob", "rocaps"}, {"ringlets", "prhi"}, {"fur", "rocaps"}, {"fur", "prhi:splits=3"}};
    for (const auto& [name, primitive] : cases) {
        const HairMesh mesh = bundled_mesh(name);
        const Parameters style = style_with(mesh, "strands=400,points=33,thickness=5");
        const PrimitiveChoice choice = parse_primitive(primitive);
        const SceneInstance instance;
        SceneOptions options;
        options.ray_extent = ray_extent;
        options.normals = true;
        options.order = SceneOptions::Order::as_built;  // the device has no other,
        options.no_skips = {"points"};                  // and stores every point twice
        options.max_leaves = 10'000;                    // several structures
        const Curves curves = grow_hair_mesh(mesh, style);
        const GpuScene host(device(), *choice.primitive,
                            {{choice.primitive->build(curves, choice.options), 0}}, {&instance, 1}, options);
        GrownModel grown = grown_model(device(), grow_on_device(device(), mesh, style), choice, ray_extent);
        const GpuScene there(device(), *choice.primitive, {std::move(grown.model)}, {&instance, 1}, options);
        const Rays rays = rays_into(curves, 3000);
        const Hits a = host.trace(rays).hits, b = there.trace(rays).hits;
        size_t hits = 0, different = 0;
        for (size_t i = 0; i < a.hits.size(); ++i) {
            hits += a.hits[i].is_hit();
            different += a.hits[i].is_hit() != b.hits[i].is_hit() || a.hits[i].curve != b.hits[i].curve ||
                         a.hits[i].t != b.hits[i].t || a.hits[i].u != b.hits[i].u ||
                         (a.hits[i].is_hit() && a.normals[i] != b.normals[i]);
        }
        EXPECT_GT(hits, 1500u) << name;
        EXPECT_EQ(different, 0u) << name << " " << primitive << ", " << hits << " hits";
        EXPECT_EQ(there.cost().leaf_count, host.cost().leaf_count);
        EXPECT_EQ(there.cost().structure_count, host.cost().structure_count);
        EXPECT_EQ(there.cost().record_bytes, host.cost().record_bytes);
    }
}

/// The device's boxes hold the exact ones, and are hardly larger than those of the host.
TEST_F(GrownModelTest, BoxesHoldTheHosts) {
    for (const char* name : {"afro", "braid", "fur"}) {
        const HairMesh mesh = bundled_mesh(name);
        const Parameters style = style_with(mesh, "strands=500");
        const PrimitiveChoice choice = parse_primitive("rocaps");
        const Geometry geometry = choice.primitive->build(grow_hair_mesh(mesh, style), choice.options);
        const GrownModel grown =
            grown_model(device(), grow_on_device(device(), mesh, style), choice, ray_extent);
        ASSERT_EQ(grown.model.leaf_count(), geometry.leaf_count());
        std::vector<Box> boxes(geometry.leaf_count());
        grown.model.on_device->boxes.download(std::as_writable_bytes(std::span(boxes)));
        size_t outside = 0;
        float excess = 0;
        for (size_t i = 0; i < boxes.size(); ++i) {
            const Box &exact = geometry.boxes[i], host = padded(exact, ray_extent);
            for (int axis = 0; axis < 3; ++axis) {
                outside +=
                    !(boxes[i].low[axis] <= exact.low[axis] && boxes[i].high[axis] >= exact.high[axis]);
                excess = std::max(
                    {excess, host.low[axis] - boxes[i].low[axis], boxes[i].high[axis] - host.high[axis]});
            }
        }
        EXPECT_EQ(outside, 0u) << name;
        EXPECT_LE(excess, 4e-6f) << name;  // metres: a ninth of a radius
        EXPECT_EQ(grown.model.on_device->curve_records.size(), geometry.curve_records.bytes.size());
        std::vector<std::byte> records(geometry.curve_records.bytes.size());
        grown.model.on_device->curve_records.download(records);
        EXPECT_EQ(records, geometry.curve_records.bytes) << name;
    }
}

TEST_F(GrownModelTest, RefusesWhatOnlyTheHostMakes) {
    const HairMesh mesh = bundled_mesh("bob");
    const auto grown = [&](const char* primitive, const char* changes) {
        return grown_model(device(), grow_on_device(device(), mesh, style_with(mesh, changes)),
                           parse_primitive(primitive), 1.0f);
    };
    EXPECT_THROW(grown("dots", "strands=10"), Error);
    EXPECT_THROW(grown("lss", "strands=10"), Error);
    // A turn and more from one point to the next: prhi needs more leaves there, rocaps does not.
    const char* wild = "strands=10,points=9,curl=0.05,curl_frequency=40";
    EXPECT_THROW(grown("prhi:splits=1", wild), Error);
    EXPECT_NO_THROW(grown("rocaps:splits=1", wild));
}

}  // namespace
}  // namespace strandlab
