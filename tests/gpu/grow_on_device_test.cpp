// Strands that grow on the device are those that grow on the host.
#include "gpu/hair_mesh/grow_on_device.h"

#include "gpu_fixture.h"
#include "unit/hair_mesh_models.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace strandlab {
namespace {

using GrowOnDeviceTest = GpuTest;
using testing_tools::bundled_mesh;
using testing_tools::hair_mesh_names;
using testing_tools::hair_radius;
using testing_tools::style_with;

/// How far apart two equally shaped sets of curves are.
struct Difference {
    size_t numbers = 0;  // whose bits differ
    double radii = 0;    // largest distance of control points
};

Difference difference(const Curves& a, const Curves& b) {
    Difference found;
    for (size_t c = 0; c < a.curves.size(); ++c)
        for (int i = 0; i < 4; ++i) {
            for (int axis = 0; axis < 4; ++axis)
                found.numbers += std::bit_cast<uint32_t>(a.curves[c][i][axis]) !=
                                 std::bit_cast<uint32_t>(b.curves[c][i][axis]);
            const glm::dvec4 d = glm::dvec4(a.curves[c][i]) - glm::dvec4(b.curves[c][i]);
            found.radii = std::max(found.radii, glm::length(d) / hair_radius);
        }
    return found;
}

/// Grows both and holds the device to the host's bits; elsewhere than on lavapipe to a hundredth of a radius.
void expect_equal(const Device& device, const HairMesh& mesh, const std::string& changes) {
    const Parameters style = style_with(mesh, changes);
    const Curves host = grow_hair_mesh(mesh, style), there = grow_on_device(device, mesh, style).download();
    ASSERT_EQ(host.curves.size(), there.curves.size());
    ASSERT_EQ(host.strands.size(), there.strands.size());
    for (size_t s = 0; s < host.strands.size(); ++s) {
        ASSERT_EQ(host.strands[s].first, there.strands[s].first);
        ASSERT_EQ(host.strands[s].count, there.strands[s].count);
    }
    const Difference found = difference(host, there);
    fmt::print("{},{}: {} of {} numbers differ, by {:.2g} radii at most\n", mesh.name, changes, found.numbers,
               16 * host.curves.size(), found.radii);
    if (device.info().is_lavapipe) {
        EXPECT_EQ(found.numbers, 0u) << mesh.name << "," << changes;
    }
    EXPECT_LE(found.radii, 0.01) << mesh.name << "," << changes;
}

TEST_F(GrowOnDeviceTest, EveryStyleHasTheHostsBits) {
    for (const char* name : hair_mesh_names) expect_equal(device(), bundled_mesh(name), "strands=300,seed=3");
}

TEST_F(GrowOnDeviceTest, EveryOperationHasTheHostsBits) {
    for (const char* name : {"bob", "fur"})
        expect_equal(
            device(), bundled_mesh(name),
            "strands=400,points=34,clump=0.7,clumps=7,curl=0.004,wave=0.003,wave_angle=35,kink=0.003,"
            "kink_angle=-70,noise=0.002,frizz=0.001,fuzz=0.01,fuzz_share=0.5,cut=0.4,cut_noise=0.3,"
            "length=0.8,thickness=3");
}

TEST_F(GrowOnDeviceTest, UnstyledAndFewPointsToo) {
    for (const char* name : {"ponytail", "fur"}) {
        expect_equal(device(), bundled_mesh(name), "strands=500,points=0");
        expect_equal(device(), bundled_mesh(name), "strands=500,points=2");
        expect_equal(device(), bundled_mesh(name), "strands=500,points=3");
    }
}

TEST_F(GrowOnDeviceTest, LevelsOfDetailMorphAlike) {
    for (const char* points : {"0.27", "0.3", "0.5", "0.013"})
        expect_equal(device(), bundled_mesh("ringlets"),
                     std::string("strands=3000,lod=0.1,lod_points=") + points);
}

/// More strands than fit at a time, and more on a face than there are root samples.
TEST_F(GrowOnDeviceTest, ManyStrandsInSeveralRounds) {
    expect_equal(device(), bundled_mesh("braid"), "strands=60000,points=40");
    expect_equal(device(), bundled_mesh("fur"), "strands=1200000,points=2,clump=0,noise=0,frizz=0");
}

TEST_F(GrowOnDeviceTest, WhatIsUploadedStaysSmall) {
    const HairMesh mesh = bundled_mesh("bob");
    const DeviceCurves few = grow_on_device(device(), mesh, style_with(mesh, "strands=100")),
                       many = grow_on_device(device(), mesh, style_with(mesh, "strands=20000"));
    EXPECT_EQ(few.table_bytes, many.table_bytes);
    EXPECT_LT(many.table_bytes, 200'000u);
    EXPECT_EQ(many.curve_count(), 20000u * mesh.style.integer("points") - 20000u);
}

}  // namespace
}  // namespace strandlab
