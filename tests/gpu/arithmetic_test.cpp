// What the device's fma does, and that the ray frame is accurate whatever it does.
#include "gpu/arithmetic.h"

#include "base/random.h"
#include "gpu_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

using ArithmeticTest = GpuTest;

/// Rays towards a point about one length from the reference, from a distance of 10^0 to 10^6 lengths.
std::vector<ArithmeticProbe> distant_rays() {
    std::vector<ArithmeticProbe> probes(20'000);
    for (size_t i = 0; i < probes.size(); ++i) {
        Random random(23, 0, i);
        ArithmeticProbe& probe = probes[i];
        const double distance = std::pow(10.0, random.range(0, 6));
        const double offset = std::pow(10.0, random.range(-1, 4));
        for (int axis = 0; axis < 3; ++axis) {
            probe.reference[axis] = static_cast<float>(offset * random.signed_unit());
            probe.middle[axis] = static_cast<float>(random.signed_unit());
            probe.direction[axis] = static_cast<float>(random.signed_unit());
        }
        for (int axis = 0; axis < 3; ++axis)
            probe.origin[axis] =
                static_cast<float>(double(probe.reference[axis]) + double(probe.middle[axis]) -
                                   distance * double(probe.direction[axis]));
    }
    return probes;
}

/// Largest error of a foot, in ulps (2^-23) of its size before and after the corrections: origin - reference
/// + t direction has at most 60 bits here, which long double holds.
double worst_error(std::span<const ArithmeticProbe> probes, std::span<const ArithmeticAnswer> answers,
                   std::array<float, 3> ArithmeticAnswer::*foot) {
    double worst = 0;
    for (size_t i = 0; i < probes.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const long double exact = ((long double)probes[i].origin[axis] - probes[i].reference[axis]) +
                                      (long double)answers[i].t_foot * probes[i].direction[axis];
            const double size =
                std::max({std::abs(double(exact)), std::abs(double(answers[i].plain_foot[axis])), 1e-6});
            const double error = std::abs(double((answers[i].*foot)[axis] - exact));
            worst = std::max(worst, error / (size * 0x1p-23));
        }
    }
    return worst;
}

TEST_F(ArithmeticTest, FmaIsProvenFusedOrNot) {
    const Arithmetic facts = arithmetic_of(device());
    EXPECT_TRUE(facts.keeps_precise) << facts.to_string();
    EXPECT_TRUE(facts.exact_products) << facts.to_string();
    if (device().info().is_lavapipe) {
        EXPECT_FALSE(facts.fuses_fma) << "lavapipe has learnt to fuse: let the frame use it";
        EXPECT_FALSE(facts.rounds_loosely()) << "TraceDevice::arithmetic() says otherwise of processors";
    }
    RecordProperty("arithmetic", facts.to_string());
}

TEST_F(ArithmeticTest, ShadersThatAreRoundedAlikeRoundAsThisProcessor) {
    const Arithmetic own = arithmetic_of(device());
    const Arithmetic facts = arithmetic_of(device(), {.rounding = own.alike()});
    EXPECT_FALSE(facts.rounds_loosely()) << facts.to_string();
    EXPECT_TRUE(facts.keeps_precise && facts.exact_products) << facts.to_string();
    EXPECT_EQ(facts.fuses_fma, own.fuses_fma) << facts.to_string();
}

TEST_F(ArithmeticTest, MendingLeavesQuotientsThatHaveNoResidue) {
    std::vector<ArithmeticProbe> probes(4);
    const float infinity = std::numeric_limits<float>::infinity();
    const float pairs[][2] = {{1, 0}, {infinity, 2}, {1, infinity}, {0, 3}};
    for (size_t i = 0; i < probes.size(); ++i) {
        probes[i].factor = pairs[i][0];
        probes[i].direction[0] = pairs[i][1];
    }
    const auto answers =
        probe_arithmetic(device(), probes, {.rounding = {.alike = true, .mends_quotients = true}});
    for (size_t i = 0; i < probes.size(); ++i) {
        EXPECT_EQ(answers[i].quotient, pairs[i][0] / pairs[i][1]) << i;
        EXPECT_EQ(answers[i].root, std::sqrt(pairs[i][0])) << i;
    }
}

TEST_F(ArithmeticTest, TheFrameIsAccurateWithoutFusedFma) {
    const std::vector<ArithmeticProbe> probes = distant_rays();
    const auto answers = probe_arithmetic(device(), probes, {});
    EXPECT_LT(worst_error(probes, answers, &ArithmeticAnswer::foot), 4);
    // What the corrections are for, and proof that this test would see their loss.
    EXPECT_GT(worst_error(probes, answers, &ArithmeticAnswer::plain_foot), 1e4);
}

TEST_F(ArithmeticTest, TheFrameMayUseFmaExactlyWhereItIsFused) {
    const std::vector<ArithmeticProbe> probes = distant_rays();
    const auto answers = probe_arithmetic(device(), probes, {.hardware_fma = true});
    const double worst = worst_error(probes, answers, &ArithmeticAnswer::foot);
    if (arithmetic_of(device()).fuses_fma)
        EXPECT_LT(worst, 4);
    else
        EXPECT_GT(worst, 1e3) << "two roundings, and nothing lost?";
}

}  // namespace
}  // namespace strandlab
