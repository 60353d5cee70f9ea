#include "report/fronts.h"

#include "report/row_fields.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

Json row(const std::string& primitive, double ms, double bytes, double p99, int wrong = 0) {
    Json all{{"rays", 1000}, {"distance", {{"p99", p99}}}};
    for (const char* outcome : {"nan", "false_hit", "false_miss", "wrong_strand", "wrong_place"})
        all[outcome] = {{"count", 0}};
    all["false_miss"]["count"] = wrong;
    return {{"model", {{"name", "tuft"}, {"hash", "1"}, {"instances", 1}}},
            {"rays", {{"name", "primary"}, {"hash", "2"}}},
            {"primitive", {{"name", primitive}}},
            {"device", {{"name", "gpu"}, {"class", "software"}, {"driver", "driver"}}},
            {"time", {{"trace_ms", {{"median", ms}}}}},
            {"memory", {{"resident_bytes", bytes}}},
            {"model_error", {{"hit_or_miss_only", false}, {"all", all}}}};
}

TEST(RowFields, WhateverARowHolds) {
    const Json row = Json::parse(R"({"a":{"b":{"c":2.5,"d":"inf","e":null,"f":[1]}},"g":"text","h":true})");
    EXPECT_EQ(number_at(row, "a.b.c"), 2.5);
    EXPECT_EQ(number_at(row, "a.b.d"), std::numeric_limits<double>::infinity());
    for (const char* path : {"a.b.e", "a.b.f", "a.b", "a.b.c.d", "x", "", ".", "a..b", "g"})
        EXPECT_FALSE(number_at(row, path)) << path;
    EXPECT_EQ(text_at(row, "g"), "text");
    EXPECT_EQ(text_at(row, "a.b.c"), "");
    EXPECT_TRUE(is_true_at(row, "h"));
    EXPECT_FALSE(is_true_at(row, "g"));
    EXPECT_EQ(field_at(Json(), "a"), nullptr);
}

TEST(Fronts, RowsOfOneGroupCompete) {
    const std::vector<Json> rows{row("lss", 1, 100, 0.3), row("prhi", 2, 50, 0.1), row("dots", 3, 200, 0.2)};
    const std::vector<FrontMarks> marks = pareto_fronts(rows);
    EXPECT_TRUE(marks[0].time_error);
    EXPECT_FALSE(marks[0].memory_error);
    EXPECT_TRUE(marks[1].time_error);
    EXPECT_TRUE(marks[1].memory_error);
    EXPECT_FALSE(marks[2].time_error);
    EXPECT_FALSE(marks[2].memory_error);
}

TEST(Fronts, SoftwareAndHardwareNeverShareOne) {
    std::vector<Json> rows{row("lss", 1, 100, 0.1), row("lss", 5, 500, 0.5)};
    EXPECT_FALSE(pareto_fronts(rows)[1].time_error);
    rows[1]["device"]["class"] = "hardware";
    EXPECT_TRUE(pareto_fronts(rows)[1].time_error);
    EXPECT_NE(comparable_group(rows[0]), comparable_group(rows[1]));
}

TEST(Fronts, OtherRaysAndModelsAreOtherGroups) {
    const Json one = row("lss", 1, 100, 0.1);
    for (const auto& [object, key] : {std::pair("model", "name"), {"model", "hash"}, {"rays", "hash"}}) {
        Json other = one;
        other[object][key] = "another";
        EXPECT_NE(comparable_group(one), comparable_group(other)) << key;
    }
    EXPECT_EQ(comparable_group(one), comparable_group(row("dots", 9, 9, 9)));
}

TEST(Fronts, WhatMissesTheHairIsNeverBest) {
    const std::vector<Json> rows{row("lss", 1, 100, 0.01, 11), row("prhi", 2, 200, 0.1, 10)};
    EXPECT_TRUE(std::isinf(row_error(rows[0]).ranking));
    const std::vector<FrontMarks> marks = pareto_fronts(rows);
    EXPECT_FALSE(marks[0].time_error);
    EXPECT_TRUE(marks[1].time_error);
    Json background = rows[1];
    background["model_error"]["all"]["agreed_misses"] = 500;
    EXPECT_DOUBLE_EQ(row_error(background).wrong_share, 0.02);
    EXPECT_TRUE(marks[0].time_wrong);  // cheaper, and almost as often right
}

TEST(Fronts, MeasuringAidsAndSecondOpinionsAreOnNone) {
    std::vector<Json> rows{row("null", 0.1, 1, 0), row("embree", 0.1, 1, 0), row("lss", 1, 1, 1)};
    rows[1]["device"]["driver"] = "Embree 3.13.5";
    const std::vector<FrontMarks> marks = pareto_fronts(rows);
    EXPECT_FALSE(marks[0].time_error || marks[0].time_wrong);
    EXPECT_FALSE(marks[1].time_error || marks[1].memory_error);
    EXPECT_TRUE(marks[2].time_error);
}

TEST(Fronts, RowsWithoutMeasurementsAreNoTrouble) {
    const std::vector<Json> rows{Json::object(), Json::array(), Json::parse(R"({"model_error":3})"),
                                 row("lss", 1, 1, 1)};
    const std::vector<FrontMarks> marks = pareto_fronts(rows);
    EXPECT_FALSE(marks[0].time_error || marks[1].time_error || marks[2].memory_wrong);
    EXPECT_TRUE(marks[3].time_error);
    EXPECT_TRUE(std::isnan(row_error(rows[0]).wrong_share));
}

}  // namespace
}  // namespace strandlab
