#include "report/choices.h"

#include "unit/support/result_rows.h"

#include <gtest/gtest.h>

#include <numeric>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::ordered_json;

std::vector<size_t> all_of(const std::vector<Json>& rows) {
    std::vector<size_t> members(rows.size());
    std::iota(members.begin(), members.end(), 0);
    return members;
}

TEST(Choices, CheapestWithinTheLimit) {
    const std::vector<Json> rows{
        to_json(result_row("dots", 1, 900, 0.4)), to_json(result_row("lss", 2, 50, 0.3)),
        to_json(result_row("prhi", 3, 100, 0.1)), to_json(result_row("rocaps", 4, 90, 0.001)),
        to_json(result_row("null", 0.1, 1, 0))};
    const Choices choices = choose(rows, all_of(rows), 0.1);
    EXPECT_EQ(choices.fastest, 2u);
    EXPECT_EQ(choices.smallest, 3u);
    EXPECT_EQ(choices.most_accurate, 3u);
    EXPECT_EQ(choices.fastest_of_all, 0u);
    EXPECT_TRUE(choices.as_fast.empty());
    EXPECT_FALSE(choose(rows, all_of(rows), 1e-6).fastest);
}

TEST(Choices, OnlyMembersCount) {
    const std::vector<Json> rows{to_json(result_row("lss", 1, 50, 0.01)),
                                 to_json(result_row("prhi", 3, 9, 0.01))};
    EXPECT_EQ(choose(rows, std::vector<size_t>{1}, 0.1).fastest, 1u);
    EXPECT_FALSE(choose(rows, {}, 0.1).fastest_of_all);
}

TEST(Choices, TimesWhoseIntervalsMeetAreNotToldApart) {
    const std::vector<Json> rows{
        to_json(result_row("lss", 100, 50, 0.01)), to_json(result_row("prhi", 101, 50, 0.01)),
        to_json(result_row("rocaps", 101, 50, 0.5)), to_json(result_row("dots", 150, 50, 0.01))};
    EXPECT_EQ(choose(rows, all_of(rows), 0.1).as_fast, std::vector<size_t>{1});
}

TEST(Choices, WrongRaysAreBeyondAnyLimit) {
    const std::vector<Json> rows{to_json(result_row("lss", 1, 50, 0.01, 11)),
                                 to_json(result_row("prhi", 2, 60, 0.05))};
    const Choices choices = choose(rows, all_of(rows), 0.1);
    EXPECT_EQ(choices.fastest, 1u);
    EXPECT_EQ(choices.most_accurate, 1u);
    EXPECT_EQ(choices.fastest_of_all, 0u);
}

}  // namespace
}  // namespace strandlab::testing_tools
