// The arithmetic that the CPU versions of the intersectors are compiled with.
#include "gpu/arithmetic.h"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

TEST(CpuArithmetic, FusesNothingUnasked) {
    const Arithmetic facts = arithmetic_of_cpu();
    EXPECT_TRUE(facts.fuses_fma) << "std::fma rounds once by definition";
    EXPECT_TRUE(facts.keeps_precise) << "compiled with contraction: -ffp-contract=off is missing";
    EXPECT_TRUE(facts.exact_products);
}

TEST(CpuArithmetic, SaysWhatIsWrong) {
    EXPECT_NE((Arithmetic{true, true, false}).to_string().find("NOT exact"), std::string::npos);
    EXPECT_NE((Arithmetic{false, true, true}).to_string().find("not fused"), std::string::npos);
}

}  // namespace
}  // namespace strandlab
