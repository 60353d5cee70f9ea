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
    EXPECT_FALSE(facts.rounds_loosely()) << facts.to_string();
}

TEST(CpuArithmetic, SaysWhatIsWrong) {
    const auto says = [](const Arithmetic& facts, const char* text) {
        return facts.to_string().find(text) != std::string::npos;
    };
    EXPECT_TRUE(says({.fuses_fma = true, .keeps_precise = true}, "NOT exact"));
    EXPECT_TRUE(says({.keeps_precise = true, .exact_products = true}, "not fused"));
    EXPECT_TRUE(says({.contracts = true}, "other products are contracted"));
    EXPECT_TRUE(says({.rough_quotients = true}, "quotients are rough"));
    EXPECT_TRUE(says({.rough_roots = true}, "roots are rough"));
    EXPECT_FALSE(Arithmetic().rounds_loosely());
}

}  // namespace
}  // namespace strandlab
