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

class RoundedIntersector : public GpuTest, public testing::WithParamInterface<const char*> {
  protected:
    /// Rays of a family through the device, its intersector rounded alike, beside the C++ float version.
    Agreement agreement_in(const char* family, uint64_t count, PairTracing how) const {
        const StressRange range{&stress_family(family), default_stress_seed, 0, count};
        const Curves strands = stress_strands(range);
        const StressPairs pairs = aimed_pairs(range, choice.primitive->surface(strands, choice.options));
        const Geometry geometry = choice.primitive->build(strands, choice.options);
        BoxCheck boxes;
        const auto plain = intersect_pairs(*choice.primitive, geometry, pairs, Precision::single, boxes);
        how.extent = extent_of(pairs.rays);
        how.no_skips.emplace_back("rounding");
        const PairScene scene(device(), *choice.primitive, geometry, range, how);
        Agreement agreement;
        add_difference(strands, pairs.rays, scene.trace(pairs.rays), plain, agreement);
        return agreement;
    }

    PrimitiveChoice choice = parse_primitive(GetParam());
};

TEST_P(RoundedIntersector, AnswersAsCppDoes) {
    const Agreement agreement = agreement_in("grazing", 2000, {.arithmetic = loose(device())});
    EXPECT_GT(agreement.both_hit, 900u);
    EXPECT_EQ(agreement.only_device + agreement.only_cpu, 0u);
    EXPECT_EQ(agreement.ulps.quantile(1), 0) << "the same bits";
}

TEST_P(RoundedIntersector, IsValidWithMendedQuotients) {
    // Where fma is not fused mending gains nothing, and loses next to nothing.
    PairTracing how{.arithmetic = loose(device()), .no_skips = {"splitting"}};
    how.arithmetic.fuses_fma = how.arithmetic.rough_quotients = true;
    const Agreement agreement = agreement_in("gentle", 500, how);
    EXPECT_EQ(agreement.only_device + agreement.only_cpu, 0u);
    EXPECT_NE(judge_agreement(agreement, choice, stress_family("gentle")).verdict, StressVerdict::fails);
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
