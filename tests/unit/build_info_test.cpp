#include "base/build_info.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

namespace strandlab {
namespace {

TEST(BuildInfo, NamesTheCommitOrSaysUnknown) {
    const std::string_view commit = build_info().commit;
    if (commit == "unknown") {
        EXPECT_FALSE(build_info().modified);
    } else {
        EXPECT_GE(commit.size(), 40u);
        EXPECT_TRUE(
            std::all_of(commit.begin(), commit.end(), [](unsigned char c) { return std::isxdigit(c); }));
    }
}

TEST(BuildInfo, HoldsWhatTheCompilerWasToldAboutRounding) {
    EXPECT_NE(build_info().flags.find("-ffp-contract=off"), std::string_view::npos);
    EXPECT_FALSE(build_info().version.empty());
    EXPECT_FALSE(build_info().compiler.empty());
    EXPECT_FALSE(build_info().build_type.empty());
}

}  // namespace
}  // namespace strandlab
