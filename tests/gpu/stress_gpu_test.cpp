// Stress pairs on the device: every ray meets its own strand, and what the device says is what the C++ float
// version says.
#include "gpu_fixture.h"
#include "measure/stress.h"

namespace strandlab {
namespace {

class StressOnDevice : public GpuTest, public testing::WithParamInterface<std::string> {};

TEST_P(StressOnDevice, AgreesWithTheFloatVersion) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    // More pairs than one structure takes; strands of one curve and of three; strands without any leaf.
    for (const char* name : {"gentle", "joints", "far 1e4", "offset 1e4", "short rays", "point"}) {
        const StressRange range{&stress_family(name), default_stress_seed, 0, 700};
        const Curves strands = stress_strands(range);
        const StressPairs pairs = stress_pairs(range, choice.primitive->surface(strands, choice.options));
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        StressTally tally;
        const auto plain =
            intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, tally.boxes);
        const auto device_hits = trace_pairs(device(), *choice.primitive, geometry, pairs);
        ASSERT_EQ(device_hits.size(), plain.size());
        tally.boxes = {};
        add_difference(pairs, device_hits, plain, tally);
        EXPECT_EQ(tally.compared, range.count);
        // The driver's own triangle test rounds otherwise than ours, the more the farther the ray begins.
        const bool triangles = geometry.is_triangles();
        EXPECT_LE(tally.differing, triangles ? range.count / 10 : 0u) << name;
        EXPECT_LE(tally.boxes.lost, triangles ? range.count / 50 : 0u) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Primitives, StressOnDevice,
                         testing::Values("lss", "rocaps", "prhi", "dots", "lss:segments=1"),
                         [](const auto& test) {
                             std::string name = test.param;
                             for (char& c : name)
                                 if (c == ':' || c == '=') c = '_';
                             return name;
                         });

}  // namespace
}  // namespace strandlab
