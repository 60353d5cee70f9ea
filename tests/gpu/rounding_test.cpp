// Every intersector in its rewritten form, with quotients and without: valid, and of the same answers.
#include "gpu/rounding.h"

#include "gpu/embedded_shaders.h"
#include "gpu_fixture.h"
#include "measure/stress.h"
#include "measure/stress_limits.h"

namespace strandlab {
namespace {

/// What the device does, said to round loosely in any case: so that "rounding" can be forced off.
Arithmetic loose(const Device& device) {
    Arithmetic arithmetic = arithmetic_of(device);
    arithmetic.contracts = true;
    return arithmetic;
}

class RoundedIntersector : public GpuTest, public testing::WithParamInterface<const char*> {};

TEST_P(RoundedIntersector, AnswersAsCppDoes) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    const StressRange range{&stress_family("grazing"), default_stress_seed, 0, 2000};
    const Curves strands = stress_strands(range);
    const StressPairs pairs = aimed_pairs(range, choice.primitive->surface(strands, choice.options));
    const Geometry geometry = choice.primitive->build(strands, choice.options);
    BoxCheck boxes;
    const auto plain = intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, boxes);
    const PairScene scene(
        device(), *choice.primitive, geometry, range,
        {.extent = extent_of(pairs.rays), .arithmetic = loose(device()), .no_skips = {"rounding"}});
    Agreement agreement;
    add_difference(strands, pairs.rays, scene.trace(pairs.rays), plain, agreement);
    EXPECT_GT(agreement.both_hit, 900u);
    EXPECT_EQ(agreement.only_device + agreement.only_cpu, 0u);
    EXPECT_EQ(agreement.ulps.quantile(1), 0) << "the same bits";
}

TEST_P(RoundedIntersector, IsValidWithMendedQuotients) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    const StressRange range{&stress_family("gentle"), default_stress_seed, 0, 500};
    const Curves strands = stress_strands(range);
    const StressPairs pairs = aimed_pairs(range, choice.primitive->surface(strands, choice.options));
    const Geometry geometry = choice.primitive->build(strands, choice.options);
    BoxCheck boxes;
    const auto plain = intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, boxes);
    PairTracing how{.extent = extent_of(pairs.rays), .no_skips = {"rounding"}};
    // Where fma is not fused mending gains nothing, and loses next to nothing.
    how.arithmetic = loose(device());
    how.arithmetic.fuses_fma = true;
    how.no_skips.emplace_back("splitting");
    const PairScene scene(device(), *choice.primitive, geometry, range, how);
    Agreement agreement;
    add_difference(strands, pairs.rays, scene.trace(pairs.rays), plain, agreement);
    EXPECT_EQ(agreement.only_device + agreement.only_cpu, 0u);
    EXPECT_NE(judge_agreement(agreement, choice, *range.family).verdict, StressVerdict::fails);
}

INSTANTIATE_TEST_SUITE_P(All, RoundedIntersector,
                         testing::Values("lss", "prhi", "rocaps", "prhi:variant=published"),
                         [](const auto& test) { return test_name(test.param); });

/// Words of the operations that a module has, by number.
size_t count(std::span<const uint32_t> module, uint32_t op) {
    size_t found = 0;
    for (size_t at = 5; at < module.size(); at += module[at] >> 16) found += (module[at] & 0xffffu) == op;
    return found;
}

TEST(Rounding, MarksEveryOperationOnce) {
    constexpr uint32_t decorate = 71, add = 129, quotient = 136;
    const auto plain = embedded_shader("prhi.rint");
    const auto alike = rounded_alike(plain, false), mended = rounded_alike(plain, true);
    EXPECT_GT(count(alike, decorate), count(plain, decorate) + count(plain, add));
    EXPECT_EQ(count(alike, quotient), count(plain, quotient));
    EXPECT_GE(count(mended, quotient), 2 * count(plain, quotient));
    // What is marked already is left alone.
    EXPECT_EQ(rounded_alike(alike, false), alike);
}

}  // namespace
}  // namespace strandlab
