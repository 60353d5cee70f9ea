#include "base/sine.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

TEST(Sine, AgreesWithTheLibrary) {
    for (int i = -2000; i <= 2000; ++i) {
        const double x = 0.0137 * i;
        EXPECT_NEAR(sin_cos(x).sin, std::sin(x), 1e-14) << x;
        EXPECT_NEAR(sin_cos(x).cos, std::cos(x), 1e-14) << x;
    }
    EXPECT_NEAR(sin_cos(1e6).sin, std::sin(1e6), 1e-10);
    EXPECT_EQ(sin_cos(0).sin, 0);
    EXPECT_EQ(sin_cos(0).cos, 1);
}

}  // namespace
}  // namespace strandlab
