// The reference against dense search, and its double against its long double version.
#include "oracle_comparison.h"

#include <gtest/gtest.h>

#include <memory>

namespace strandlab {
namespace {

using namespace oracle_cases;

class OracleAccuracy : public testing::TestWithParam<int> {
  protected:
    Family family() const { return static_cast<Family>(GetParam()); }
    /// t is a double: its last bit from 3 units away, in radii, with a factor of ten.
    double floor() const { return family() == Family::thin ? 1e-9 : 1e-11; }
};

TEST_P(OracleAccuracy, SpheresAgreeWithDenseSearch) {
    for (const Caps caps : {Caps::round, Caps::open}) {
        const Tally tally = compare_all(family(), count(40), [&](const Curve& curve) {
            return [&](const Ray& ray) { return against_search(curve, ray, Surface::Sweep::sphere, caps); };
        });
        EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
        EXPECT_GT(tally.hits, tally.rays / 10) << tally.text();
        EXPECT_LT(tally.worst, floor()) << tally.text();
        fmt::print("{} spheres {}: {}\n", name_of(family()), name_of(caps), tally.text());
    }
}

TEST_P(OracleAccuracy, DiscsAgreeWithDenseSearch) {
    const Tally tally = compare_all(family(), count(40), [&](const Curve& curve) {
        return [&](const Ray& ray) { return against_search(curve, ray, Surface::Sweep::disc, Caps::open); };
    });
    EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
    EXPECT_GT(tally.hits, tally.rays / 10) << tally.text();
    EXPECT_LT(tally.worst, floor()) << tally.text();
    fmt::print("{} discs: {}\n", name_of(family()), tally.text());
}

TEST_P(OracleAccuracy, DoubleAgreesWithLongDouble) {
    for (const Surface::Sweep sweep : {Surface::Sweep::sphere, Surface::Sweep::disc}) {
        const Tally tally = compare_all(family(), count(100), [&](const Curve& curve) {
            return
                [surface = std::make_shared<Surface>(surface_of(curve, sweep, Caps::round))](const Ray& ray) {
                    const Oracle oracle(*surface);
                    EXPECT_EQ(oracle.trace(ray).starts_inside,
                              oracle.trace(ray, OracleOptions{.extended = true}).starts_inside);
                    return against_long_double(oracle, ray);
                };
        });
        EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
        EXPECT_LT(tally.worst, floor()) << tally.text();
        fmt::print("{} {} long double: {}\n", name_of(family()),
                   sweep == Surface::Sweep::disc ? "discs" : "spheres", tally.text());
    }
}

INSTANTIATE_TEST_SUITE_P(Families, OracleAccuracy, testing::Range(0, static_cast<int>(Family::count)),
                         [](const auto& tested) {
                             return std::string(name_of(static_cast<Family>(tested.param)));
                         });

}  // namespace
}  // namespace strandlab
