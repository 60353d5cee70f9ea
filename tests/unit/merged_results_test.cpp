#include "report/merged_results.h"

#include "base/error.h"
#include "base/file.h"
#include "report/row_fields.h"
#include "unit/support/result_rows.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::ordered_json;

class MergedResultsTest : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::vector<Json>& rows) const {
        std::string lines;
        for (const Json& row : rows) lines += to_line(row) + "\n";
        write_file(folder_ / name, lines);
        return folder_ / name;
    }
    std::string path(const std::string& name) const { return folder_ / name; }

  private:
    TestFolder folder_;
};

Json row(const std::string& primitive, double ms = 1) { return to_json(result_row(primitive, ms, 100, 0.1)); }

/// A row as case `number` of a sweep of two models and two primitives in four shards.
Json sweep_row(size_t number) {
    Json one = row(number % 2 == 0 ? "lss" : "prhi");
    one["key"] = number;
    one["key"] = "case " + std::to_string(number);
    one["sweep"] = {{"id", "00000000000000aa"},   {"case", number},      {"cases", 4},
                    {"shard", number + 1},        {"shards", 4},         {"models", {"curly", "fur"}},
                    {"resolutions", {"640x360"}}, {"rays", {"primary"}}, {"primitives", {"lss", "prhi"}}};
    return one;
}

TEST_F(MergedResultsTest, LaterRowsReplaceEarlierOnesOfTheSameCase) {
    const std::string a = write("a.jsonl", {row("lss", 1), row("prhi", 2)}),
                      b = write("b.jsonl", {row("lss", 3)});
    const MergedResults merged = merge_result_files(std::vector{a, b});
    ASSERT_EQ(merged.rows.size(), 2u);
    EXPECT_EQ(merged.replaced, 1u);
    double sum = 0;
    for (const Json& one : merged.rows) sum += number_or_nan(one, "time.trace_ms.median");
    EXPECT_EQ(sum, 5);
    EXPECT_TRUE(merged.missing.empty());
    EXPECT_TRUE(merged.silent_shards.empty());
}

TEST_F(MergedResultsTest, ShardsAreOneSweepAndWhatIsMissingHasAName) {
    const std::string a = write("a.jsonl", {sweep_row(3)}),
                      b = write("b.jsonl", {sweep_row(0), sweep_row(1)});
    const MergedResults merged = merge_result_files(std::vector{a, b});
    ASSERT_EQ(merged.rows.size(), 3u);
    EXPECT_EQ(text_at(merged.rows[0], "key"), "case 0");
    EXPECT_EQ(text_at(merged.rows[2], "key"), "case 3");
    ASSERT_EQ(merged.missing.size(), 1u);
    for (const char* part : {"fur", "640x360", "primary", "lss"})
        EXPECT_NE(merged.missing[0].find(part), std::string::npos) << merged.missing[0];
    EXPECT_EQ(merged.silent_shards, std::vector<std::string>{"shard 3 of 4 of sweep 00000000000000aa"});
    const std::string c = write("c.jsonl", {sweep_row(2)});
    EXPECT_TRUE(merge_result_files(std::vector{a, b, c}).missing.empty());
    EXPECT_TRUE(merge_result_files(std::vector{c, b, a}).silent_shards.empty());
}

TEST_F(MergedResultsTest, StressCellsStandApart) {
    const Json cell{{"family", "grazing"}, {"primitive", "lss"}, {"verdict", "holds"}};
    const MergedResults merged = merge_result_files(std::vector{write("a.jsonl", {cell, row("lss")})});
    EXPECT_EQ(merged.rows.size(), 1u);
    EXPECT_EQ(merged.stress.size(), 1u);
}

TEST_F(MergedResultsTest, OtherObjectsAreNamedWithFileAndLine) {
    const std::string file = write("a.jsonl", {row("lss"), Json{{"hits", 3}}});
    try {
        merge_result_files(std::vector{file});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find(file + ": line 2"), std::string::npos) << error.what();
    }
    EXPECT_THROW(merge_result_files(std::vector{path("none.jsonl")}), Error);
}

TEST_F(MergedResultsTest, CutOffLastLinesAreLeftOut) {
    const std::string line = to_line(row("lss"));
    write_file(path("a.jsonl"), line + "\n" + line.substr(0, line.size() / 2));
    EXPECT_EQ(merge_result_files(std::vector{path("a.jsonl")}).rows.size(), 1u);
}

TEST_F(MergedResultsTest, SamplesAreDroppedAndFiguresKept) {
    const MergedResults merged = merge_result_files(std::vector{write("a.jsonl", {row("lss", 7)})});
    const Json& one = merged.rows.at(0);
    EXPECT_EQ(field_at(one, "time.samples_ms"), nullptr);
    EXPECT_EQ(number_at(one, "time.trace_ms.median"), 7);
    EXPECT_EQ(field_at(one, "model_error.inside"), nullptr);
    EXPECT_EQ(number_at(one, "model_error.all.distance.p99"), 0.1);
    EXPECT_EQ(number_at(one, "intersector_error.decisive.rays"), 1000);
}

TEST_F(MergedResultsTest, FieldsOfAnyTypeAreNoTrouble) {
    Json odd = row("lss");
    odd["time"] = 3;
    odd["model_error"] = "none";
    odd["intersector_error"] = {{"decisive", {1, 2}}};
    odd["sweep"] = {{"case", "x"}, {"shard", -1}, {"shards", "inf"}, {"models", 7}};
    EXPECT_EQ(merge_result_files(std::vector{write("a.jsonl", {odd})}).rows.size(), 1u);
}

}  // namespace
}  // namespace strandlab::testing_tools
