// Sweeps: lists in specifications, numbering and splitting of cases, merging of rows.
#include "report/sweep.h"

#include "base/error.h"
#include "primitives/choice_list.h"
#include "report/merge.h"
#include "report/result_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

TEST(ChoiceList, ListsAndRangesStandForEveryCombination) {
    EXPECT_EQ(expand_lists("lss"), Texts{"lss"});
    EXPECT_EQ(expand_lists("lss:segments=4"), Texts{"lss:segments=4"});
    EXPECT_EQ(expand_lists("lss:segments=1,2,4"),
              (Texts{"lss:segments=1", "lss:segments=2", "lss:segments=4"}));
    EXPECT_EQ(expand_lists("prhi:splits=1..3"), (Texts{"prhi:splits=1", "prhi:splits=2", "prhi:splits=3"}));
    EXPECT_EQ(expand_lists("dots:tolerance=1,0.3"), (Texts{"dots:tolerance=1", "dots:tolerance=0.3"}));
    EXPECT_EQ(expand_lists("prhi:variant=published,robust,splits=1,3..4"),
              (Texts{"prhi:variant=published,splits=1", "prhi:variant=published,splits=3",
                     "prhi:variant=published,splits=4", "prhi:variant=robust,splits=1",
                     "prhi:variant=robust,splits=3", "prhi:variant=robust,splits=4"}));
    EXPECT_EQ(parse_primitives("lss:segments=4,8").at(0).label(), "lss");  // the default
}

TEST(ChoiceList, WhatIsWrongIsSaid) {
    for (const char* text : {"prhi:splits=8..1", "prhi:splits=1..5000", "lss:segments=1..40,tolerance=1..40"})
        EXPECT_THROW(expand_lists(text), Error) << text;
    for (const char* text : {"lss:segments", "lss:segments=", "lss:segments=1,", "lss:,segments=1",
                             "lss:segments=1..x", "lss:segments=0..2", "lss:"})
        EXPECT_THROW(
            {
                parse_primitives(text);
                if (std::string_view(text) == "lss:") fail(ExitCode::usage, "nothing to expand");
            },
            Error)
            << text;
}

SweepAxes some_axes() {
    return {{"a", "b"}, {"8x8", "9x9"}, {"primary", "shadow", "x.npy"}, {"lss", "dots"}};
}

TEST(Sweep, EveryCombinationHasItsNumberAndName) {
    const SweepAxes axes = some_axes();
    ASSERT_EQ(axes.cases(), 24u);
    std::set<std::string> names;
    size_t expected = 0;
    for (size_t m = 0; m < 2; ++m)
        for (size_t r = 0; r < 2; ++r)
            for (size_t s = 0; s < 3; ++s)
                for (size_t p = 0; p < 2; ++p) {
                    EXPECT_EQ(axes.number(m, r, s, p), expected);
                    names.insert(axes.name(expected++));
                }
    EXPECT_EQ(names.size(), 24u);
    EXPECT_EQ(axes.name(7), "a 9x9 primary dots");
    SweepAxes other = axes;
    other.rays[0] = "primaryx";
    EXPECT_NE(axes.hash(), other.hash());
    EXPECT_NE(axes.hash(), axes.hash("seed=2"));
}

TEST(Sweep, ShardsAreAPartition) {
    for (const size_t cases : {size_t(0), size_t(1), size_t(7), size_t(24)})
        for (const uint32_t count : {1u, 3u, 4u, 40u}) {
            std::vector<size_t> sizes(count, 0);
            for (size_t number = 0; number < cases; ++number) {
                int holders = 0;
                for (uint32_t index = 1; index <= count; ++index)
                    if (Shard{index, count}.holds(number, cases)) {
                        ++holders;
                        ++sizes[index - 1];
                    }
                EXPECT_EQ(holders, 1) << number;
            }
            const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
            EXPECT_LE(*most - *least, 1u);
        }
    EXPECT_EQ(parse_shard("2/4").index, 2u);
    for (const char* text : {"", "1", "0/4", "5/4", "1/0", "1.5/2", "1/2/3", "a/b", "nan/2"})
        EXPECT_THROW(parse_shard(text), Error) << text;
}

Json row_of(size_t number, const char* key, double time = 1) {
    ResultRow row;
    row.sweep = {std::make_shared<SweepAxes>(some_axes()), 7, number, {}};
    row.trace_ms = {time};
    Json json = to_json(row);
    json["key"] = key;
    return json;
}

TEST(Merge, KeepsTheLastRowOfEachKeyInTheOrderOfCases) {
    const std::vector<Json> merged =
        merged_rows({row_of(5, "e"), row_of(1, "b"), row_of(0, "a"), row_of(1, "b", 2)});
    ASSERT_EQ(merged.size(), 3u);
    EXPECT_EQ(merged[0]["key"], "a");
    EXPECT_EQ(merged[1]["key"], "b");
    EXPECT_EQ(merged[1]["time"]["samples_ms"][0], 2.0);
    EXPECT_EQ(merged[2]["key"], "e");
}

TEST(Merge, NamesWhatIsMissing) {
    std::vector<Json> rows;
    for (size_t number = 0; number < 24; ++number)
        if (number != 7 && number != 23) rows.push_back(row_of(number, std::to_string(number).c_str()));
    EXPECT_EQ(missing_cases(rows), (Texts{"a 9x9 primary dots", "b 9x9 x.npy dots"}));
    EXPECT_TRUE(missing_cases({}).empty());
    // Rows of an older schema, or of other programs, are of no sweep.
    EXPECT_TRUE(missing_cases(std::vector<Json>{Json{{"key", "x"}}, Json::object()}).empty());
}

}  // namespace
}  // namespace strandlab
