#include "base/error.h"
#include "report/result_csv.h"
#include "report/result_json.h"
#include "report/result_writer.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace strandlab {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

ResultRow measured_row() {
    ResultRow row;
    row.model = {"tuft, \"small\"", 0xABC, 1000, 100, 2};
    row.rays = {"primary", 2'000'000, 0x1, 1000, 2000, 1};
    row.primitive = facts_of(parse_primitive("lss:segments=8"), Caps::flat);
    row.device = {"llvmpipe", "Mesa 25", "1.4.305", "cpu", false, true};
    row.trace_ms = {10, 12, 11};
    row.geometry_ms = 3;
    row.cost.emplace();
    row.cost->builds.kept_bytes = 64000;
    row.cost->record_bytes = 16000;
    row.cost->leaf_count = 8000;
    Comparison& error = row.intersector_error.emplace();
    error.margin = 1e-3;
    error.all.rays = 100;
    error.decisive.rays = 90;
    error.decisive.matches = 90;
    error.decisive.false_miss = {0, 90};
    error.decisive.measures[0] = {90, 0.5, 1, 2, 3, std::numeric_limits<double>::infinity(), 42};
    row.seed = 7;
    return row;
}

TEST(ResultRow, DerivesRatesAndMemory) {
    const ResultRow row = measured_row();
    EXPECT_EQ(row.trace_time()->median, 11);
    EXPECT_NEAR(*row.mrays_per_second(), 2e6 / 11e-3 / 1e6, 1e-9);
    EXPECT_EQ(row.resident_bytes(), 80000u);
    EXPECT_EQ(row.bytes_per_curve(), 80);
    EXPECT_TRUE(row.primitive.caps_fell_back());
    EXPECT_EQ(row.device.device_class(), "software");
}

TEST(ResultRow, WhatWasNotMeasuredIsEmpty) {
    const ResultRow row;
    EXPECT_FALSE(row.trace_time());
    EXPECT_FALSE(row.mrays_per_second());
    EXPECT_FALSE(row.bytes_per_curve());
    const Json json = to_json(row);
    EXPECT_TRUE(json["time"]["trace_ms"].is_null());
    EXPECT_TRUE(json["time"]["build_ms"].is_null());
    EXPECT_TRUE(json["memory"]["kept_bytes"].is_null());
    EXPECT_TRUE(json["intersector_error"].is_null());
}

TEST(ResultRow, KeysTellCasesApart) {
    const ResultRow row = measured_row();
    EXPECT_EQ(row.key(),
              "tuft, \"small\" 0000000000000abc x2 | primary 0000000000000001 | lss:segments=8 caps=round | "
              "llvmpipe | seed=7");
    ResultRow other = row;
    other.trace_ms = {1};
    other.context.time = "later";
    EXPECT_EQ(row.key(), other.key());
    other.rays.hash = 2;
    EXPECT_NE(row.key(), other.key());
}

TEST(ResultJson, KeysComeInAFixedOrder) {
    const std::string line = to_line(to_json(measured_row()));
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_TRUE(line.starts_with("{\"schema\":2,\"command\":\"bench\",\"key\":")) << line;
    EXPECT_NE(
        line.find("\"model\":{\"name\":\"tuft, \\\"small\\\"\",\"hash\":\"0000000000000abc\",\"curves\":1000,"
                  "\"strands\":100,\"instances\":2,\"spec\":\"\"}"),
        std::string::npos)
        << line;
    EXPECT_NE(line.find("\"samples_ms\":[10.0,12.0,11.0]"), std::string::npos) << line;
    EXPECT_NE(line.find("\"caps\":\"round\",\"wanted_caps\":\"flat\",\"caps_fell_back\":true"),
              std::string::npos);
    EXPECT_NE(line.find("\"class\":\"software\",\"ray_tracing_hardware\":false,\"memory_bytes\":0,"
                        "\"validation_layers\":true"),
              std::string::npos)
        << line;
    EXPECT_NE(
        line.find(
            "\"distance\":{\"count\":90,\"p50\":0.5,\"p95\":1.0,\"p99\":2.0,\"p999\":3.0,\"max\":\"inf\","
            "\"worst_ray\":42,\"decades\":[0,"),
        std::string::npos)
        << line;
}

TEST(ResultRow, SettingsThatChangeACaseAreInItsKey) {
    ResultRow row = measured_row();
    const std::string plain = row.key();
    row.settings.repeat = 99;
    EXPECT_EQ(row.key(), plain);
    row.settings.compaction = false;
    row.settings.leaf_order = "file";
    EXPECT_EQ(row.key(), plain + " order=file compaction=0");
    row.settings.cull = "reach";
    EXPECT_EQ(row.key(), plain + " order=file compaction=0 cull=reach");
}

TEST(ResultRow, SaysWhatToDoAboutAWideSpread) {
    ResultRow row = measured_row();
    row.trace_ms = {10, 10.1, 10.2};
    EXPECT_EQ(row.warning(), "");
    row.trace_ms = {10, 20, 30};
    EXPECT_DOUBLE_EQ(*row.spread(), 0.5);
    EXPECT_NE(row.warning().find("+-50 %"), std::string::npos) << row.warning();
    EXPECT_NE(row.warning().find("--repeat"), std::string::npos) << row.warning();
    row.trace_ms = {10};
    EXPECT_FALSE(row.spread());
    EXPECT_EQ(row.warning(), "");
}

TEST(ResultJson, HoldsEverySampleAndTheSweep) {
    ResultRow row = measured_row();
    auto axes = std::make_shared<SweepAxes>();
    *axes = {{"a.hair"}, {"640x360"}, {"primary", "diffuse"}, {"lss", "prhi"}};
    row.sweep = {axes, 0xABCD, 3, {2, 4}};
    row.wall_ms = {11, 13, 12};
    row.positions = {1, 0, 1};
    row.group = "g";
    row.ratio = {"dots", {0.5, 0.75, 0.5}};
    const Json json = to_json(row);
    EXPECT_EQ(json["sweep"]["id"], "000000000000abcd");
    EXPECT_EQ(json["sweep"]["case"], 3);
    EXPECT_EQ(json["sweep"]["cases"], 4);
    EXPECT_EQ(json["sweep"]["shard"], 2);
    EXPECT_EQ(json["sweep"]["primitives"], Json({"lss", "prhi"}));
    EXPECT_EQ(json["time"]["wall_ms"]["median"], 12.0);
    EXPECT_EQ(json["time"]["wall_samples_ms"], Json({11.0, 13.0, 12.0}));
    EXPECT_EQ(json["time"]["positions"], Json({1, 0, 1}));
    EXPECT_EQ(json["time"]["ratio"]["baseline"], "dots");
    EXPECT_EQ(json["time"]["ratio"]["median"], 0.5);
    EXPECT_EQ(json["memory"]["buffer_bytes"], 16000);
    EXPECT_EQ(json["context"]["shaders"].get<std::string>().size(), 16u);
}

TEST(ResultJson, NumbersThatAreNotFiniteAreWords) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value : {0.0, 0.1, -1e300, 5e-324, infinity, -infinity})
        EXPECT_EQ(number_of(Json::parse(to_line(json_number(value)))), value);
    EXPECT_EQ(to_line(json_number(std::nan(""))), "\"nan\"");
    EXPECT_TRUE(std::isnan(*number_of("nan")));
    EXPECT_FALSE(number_of(Json()));
    EXPECT_FALSE(number_of("text"));
}

TEST(ResultJson, NamesMayBeAnyBytes) {
    ResultRow row;
    row.model.name = "hair\xFF\n.usd";
    const Json parsed = Json::parse(to_line(to_json(row)));
    EXPECT_EQ(parsed["model"]["name"], "hair\xEF\xBF\xBD\n.usd");
}

TEST(ResultCsv, QuotesAsRfc4180) {
    EXPECT_EQ(csv_field("plain"), "plain");
    EXPECT_EQ(csv_field(""), "");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("say \"a\""), "\"say \"\"a\"\"\"");
    EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csv_field(" padded"), "\" padded\"");
    const std::vector<std::string> fields{"a", "", "b,c"};
    EXPECT_EQ(csv_line(fields), "a,,\"b,c\"");
}

/// The field of a column.
std::string csv_value(const ResultRow& row, std::string_view column) {
    const std::vector<std::string> fields = csv_fields(to_json(row));
    EXPECT_EQ(fields.size(), csv_columns().size());
    const auto found = std::find(csv_columns().begin(), csv_columns().end(), column);
    if (found == csv_columns().end()) return "no such column";
    return fields[static_cast<size_t>(found - csv_columns().begin())];
}

TEST(ResultCsv, EveryFieldIsDescribed) {
    std::ostringstream text;
    text << std::ifstream(STRANDLAB_MODELS "/../source/report/README.md").rdbuf();
    ASSERT_FALSE(text.str().empty());
    for (const std::string& column : csv_columns()) {
        if (column.starts_with("profile.") || column.starts_with("settings.")) continue;  // in their headers
        for (size_t begin = 0; begin <= column.size();) {
            const size_t end = std::min(column.find('.', begin), column.size());
            EXPECT_NE(text.str().find("`" + column.substr(begin, end - begin) + "`"), std::string::npos)
                << column;
            begin = end + 1;
        }
    }
}

TEST(ResultCsv, FiguresAtDistancesAreLists) {
    ResultRow row;
    row.distances.resize(3);
    for (size_t i = 0; i < 3; ++i) {
        row.distances[i].scale = double(1 << i);
        row.distances[i].flip = 0.25 * double(i);
    }
    row.distances[1].depth_bias = -0.5;
    EXPECT_EQ(csv_value(row, "distances.scale"), "1.0;2.0;4.0");
    EXPECT_EQ(csv_value(row, "distances.flip"), "0.0;0.25;0.5");
    EXPECT_EQ(csv_value(row, "distances.depth_bias"), ";-0.5;");
    EXPECT_EQ(csv_value(ResultRow{}, "distances.flip"), "");
    row.profile.emplace().shaders = {{"closest hit", "registers", "32"}, {"intersection", "registers", "48"}};
    EXPECT_EQ(csv_value(row, "profile.shaders.value"), "32;48");
    EXPECT_EQ(csv_value(ResultRow{}, "seed"), csv_value(row, "seed"));
}

TEST(ResultCsv, EveryColumnIsFilledFromTheRow) {
    const ResultRow row = measured_row();
    EXPECT_EQ(csv_value(row, "model.name"), "tuft, \"small\"");
    EXPECT_EQ(csv_value(row, "time.trace_ms.median"), "11.0");
    EXPECT_EQ(csv_value(row, "time.samples_ms"), "10.0;12.0;11.0");
    EXPECT_EQ(csv_value(row, "primitive.parameters").substr(0, 11), "segments=8,");
    EXPECT_EQ(csv_value(row, "memory.bytes_per_curve"), "80.0");
    EXPECT_EQ(csv_value(row, "intersector_error.decisive.distance.max"), "inf");
    EXPECT_EQ(csv_value(row, "intersector_error.decisive.residual.max"), "");
    EXPECT_EQ(csv_value(row, "intersector_error.decisive.false_miss.trials"), "90");
    EXPECT_EQ(csv_value(row, "intersector_error.all.rays"), "100");
    EXPECT_EQ(csv_value(row, "model_error.decisive.rays"), "");
    EXPECT_EQ(csv_value(row, "seed"), "7");
    EXPECT_EQ(csv_value(ResultRow(), "memory.kept_bytes"), "");
    EXPECT_EQ(csv_columns().front(), "schema");
    EXPECT_EQ(csv_columns().back(), "context.time");
}

class ResultFiles : public testing::Test {
  protected:
    std::string path(const char* name) const { return folder_ / name; }
    static std::string text_of(const std::string& path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }

  private:
    testing_tools::TestFolder folder_;
};

TEST_F(ResultFiles, GrowRowByRow) {
    ResultRow row = measured_row();
    ResultWriter(path("r.jsonl"), path("r.csv")).add(row);
    row.seed = 8;
    ResultWriter(path("r.jsonl"), path("r.csv")).add(row);
    const std::vector<Json> rows = read_json_lines(path("r.jsonl"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0], to_json(measured_row()));
    EXPECT_EQ(rows[1]["seed"], 8);
    const std::string csv = text_of(path("r.csv"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_EQ(csv.find("schema,"), 0u);
    EXPECT_EQ(csv.rfind("schema,"), 0u) << "one header";
}

TEST_F(ResultFiles, LoseATornLastLineAndNothingElse) {
    const std::string whole = to_line(to_json(measured_row()));
    ResultRow next = measured_row();
    next.seed = 8;
    for (const size_t cut : {size_t(1), size_t(5000), whole.size() - 1}) {
        std::ofstream(path("t.jsonl")) << whole << "\n" << whole.substr(0, cut);
        std::ofstream(path("t.csv")) << csv_line(csv_columns()) << "\n2,bench";
        const ResultWriter writer(path("t.jsonl"), path("t.csv"), true);
        ASSERT_EQ(writer.rows().size(), 1u);
        writer.add(next);
        const std::vector<Json> rows = read_json_lines(path("t.jsonl"));
        ASSERT_EQ(rows.size(), 2u);
        EXPECT_EQ(rows[1]["seed"], 8);
        const std::string csv = text_of(path("t.csv"));
        EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    }
    // Whole, but for its newline.
    std::ofstream(path("t.jsonl")) << whole << "\n" << whole;
    EXPECT_EQ(ResultWriter(path("t.jsonl"), "", true).rows().size(), 2u);
    EXPECT_TRUE(ResultWriter(path("absent"), "", true).rows().empty());
}

TEST_F(ResultFiles, OnlyWhatWasAskedForIsWritten) {
    ResultWriter("", "").add(measured_row());
    ResultWriter("", path("only.csv")).add(measured_row());
    EXPECT_FALSE(fs::exists(path("r.jsonl")));
    EXPECT_TRUE(fs::exists(path("only.csv")));
}

TEST_F(ResultFiles, RefusesCsvFilesOfOthers) {
    std::ofstream(path("r.csv")) << "a,b\n1,2\n";
    EXPECT_THROW(ResultWriter("", path("r.csv")), Error);
    EXPECT_EQ(text_of(path("r.csv")), "a,b\n1,2\n");
    EXPECT_THROW(ResultWriter(path("no/such/folder"), "").add(measured_row()), Error);
}

TEST_F(ResultFiles, ReadsAroundACutOffLineButNotOverDamage) {
    std::ofstream(path("cut")) << "{\"a\":1}\n\n{\"a\":2}\n{\"a\":";
    EXPECT_EQ(read_json_lines(path("cut")).size(), 2u);
    std::ofstream(path("complete")) << "{\"a\":1}\n{\"a\":2}";
    EXPECT_EQ(read_json_lines(path("complete")).size(), 2u);
    std::ofstream(path("damaged")) << "{\"a\":1}\nnonsense\n{\"a\":2}\n";
    try {
        read_json_lines(path("damaged"));
        FAIL() << "a damaged line was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
    }
    EXPECT_THROW(read_json_lines(path("absent")), Error);
    EXPECT_THROW(read_json_lines(path("")), Error);
}

TEST(Context, KnowsProgramAndMachine) {
    const Context context = current_context();
    for (const std::string& text :
         {context.version, context.commit, context.compiler, context.cpu, context.system})
        EXPECT_FALSE(text.empty());
    EXPECT_GE(context.cores, 1u);
    ASSERT_EQ(context.time.size(), 20u);
    EXPECT_EQ(context.time.back(), 'Z');
}

}  // namespace
}  // namespace strandlab
