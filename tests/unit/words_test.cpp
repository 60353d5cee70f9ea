// What result rows say in sentences.
#include "report/words.h"

#include "report/article_table.h"
#include "report/result_json.h"
#include "report/result_table.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

Json row_of(const char* primitive, double ms, uint64_t bytes, double p99, uint64_t wrong = 0) {
    ResultRow row;
    row.model = {"tuft", 0xABC, 10, 5};
    row.rays = {"primary", 100, 1, 10, 10, 1};
    row.rays.resolution = "10x10";
    row.primitive = facts_of(parse_primitive(primitive), Caps::round);
    row.device.name = "llvmpipe";
    row.trace_ms = {ms, ms, ms};
    row.cost.emplace();
    row.cost->builds.kept_bytes = bytes;
    row.cost->builds.input_bytes = 3'000'000;
    row.cost->record_bytes = 0;
    Comparison& error = row.model_error.emplace();
    error.all.rays = 100;
    error.all.matches = 100 - wrong;
    error.all.false_miss = {wrong, 100};
    error.all.measures[0] = {100 - wrong, p99, p99, p99, p99, p99, 0};
    return to_json(row);
}

TEST(Words, NameTheFastestAndTheSmallestWithinTheLimit) {
    const std::vector<Json> rows{row_of("null", 1, 10, 0), row_of("dots", 2, 400, 0.4),
                                 row_of("lss", 3, 200, 0.05, 20), row_of("prhi", 4, 300, 0.01),
                                 row_of("rocaps", 5, 250, 0.001)};
    const std::vector<std::string> words = result_words(rows);
    ASSERT_EQ(words.size(), 1u);
    EXPECT_NE(words[0].find(
                  "tuft, primary rays 10x10, software traversal: fastest with p99 <= 0.10 r: prhi (4.00 ms, "
                  "30.0 B/curve, p99 0.010 r"),
              std::string::npos)
        << words[0];
    EXPECT_NE(words[0].find("smallest: rocaps (5.00 ms, 25.0 B/curve"), std::string::npos) << words[0];
    EXPECT_NE(words[0].find("fastest of all: dots (2.00 ms"), std::string::npos) << words[0];
    EXPECT_EQ(words[0].find("null"), std::string::npos);
    EXPECT_NE(result_words(rows, 1e-6)[0].find("none with p99 <= 1.0e-06 r"), std::string::npos)
        << result_words(rows, 1e-6)[0];
    EXPECT_NE(result_words(rows, 0.002)[0].find(
                  "rocaps (5.00 ms, 25.0 B/curve, p99 0.0010 r, 0 % of the rays wrong), "
                  "also the smallest"),
              std::string::npos)
        << result_words(rows, 0.002)[0];
}

TEST(Words, ChooseNothingWithoutErrors) {
    std::vector<Json> rows{row_of("prhi", 4, 300, 0.01)};
    rows[0]["model_error"] = nullptr;
    EXPECT_NE(result_words(rows).at(0).find("no errors to choose by"), std::string::npos);
    EXPECT_TRUE(result_words({}).empty());
}

TEST(Words, DeviceClassesAreNotMixed) {
    std::vector<Json> rows{row_of("prhi", 4, 300, 0.01), row_of("rocaps", 5, 250, 0.001)};
    rows[1]["device"]["class"] = "hardware";
    const std::vector<std::string> words = result_words(rows);
    ASSERT_EQ(words.size(), 2u);
    EXPECT_NE(words[1].find("hardware traversal: fastest with p99 <= 0.10 r: rocaps"), std::string::npos);
}

TEST(ResultTable, HasOneTableForEachRaySetAndMarksFronts) {
    std::vector<Json> rows{row_of("dots", 2, 400, 0.4), row_of("prhi", 4, 300, 0.01),
                           row_of("lss", 5, 500, 0.5)};
    rows.push_back(rows[0]);
    rows[3]["rays"]["name"] = "shadow";
    const std::string text = result_table(rows);
    EXPECT_NE(text.find("tuft: 5 strands, 10 curves; 100 primary rays; errors of 100 of them"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("100 shadow rays"), std::string::npos);
    EXPECT_NE(text.find("\nprhi       open*  TM "), std::string::npos) << text;
    EXPECT_NE(text.find("\ndots       open*  T "), std::string::npos) << text;
    EXPECT_NE(text.find("\nlss        round    "), std::string::npos) << text;
    // Every cell stands below its heading: the last is the intersector's error, which these rows lack.
    EXPECT_NE(text.find("strand  in own  dt p50  dt p99  normal p99  own wrong  own dt p99\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("       -       0    0.40    0.40           -          -           -\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(result_table({}), "");
    EXPECT_FALSE(result_table(std::vector<Json>{Json::object()}).empty());  // a strange row
}

TEST(ArticleTable, StatesBuffersApartFromStructures) {
    const std::string text = article_table(std::vector<Json>{row_of("dots", 2, 4'000'000, 0.4, 5)});
    EXPECT_NE(text.find("10      dots       2.000   0    3.000       0      4.000"), std::string::npos)
        << text;
    EXPECT_NE(text.find("10x10"), std::string::npos);
}

}  // namespace
}  // namespace strandlab
