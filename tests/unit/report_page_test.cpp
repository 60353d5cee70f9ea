#include "base/file.h"
#include "report/html/figures.h"
#include "report/html/page.h"
#include "report/html/resources.h"
#include "unit/support/result_rows.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::ordered_json;

MergedResults results_of(std::vector<Json> rows) {
    MergedResults results;
    results.rows = std::move(rows);
    return results;
}

MergedResults some_results() {
    return results_of({to_json(result_row("lss", 1, 90, 0.3)), to_json(result_row("prhi", 2, 80, 0.05)),
                       to_json(result_row("rocaps", 3, 70, 0.001))});
}

/// The text between two others.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const size_t from = text.find(begin) + begin.size();
    return text.substr(from, text.find(end, from) - from);
}

Json table_of(const std::string& page) {
    return Json::parse(between(page, "id=\"table-data\">", "</script>"));
}

TEST(ReportPage, TemplatesAreFilledOnce) {
    EXPECT_EQ(filled_template("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
}

TEST(ReportPage, SaysWhatToUseFirst) {
    const std::string page = report_page(some_results(), {});
    EXPECT_NE(page.find("Fastest with p99 ≤ 0.1 r</b>: <span class=\"primitive s2\">prhi"),
              std::string::npos);
    EXPECT_LT(page.find("id=\"words\""), page.find("id=\"tradeoffs\""));
    EXPECT_LT(page.find("id=\"tradeoffs\""), page.find("id=\"rows\""));
}

TEST(ReportPage, AsksTheNetworkForNothing) {
    const std::string page = report_page(some_results(), {});
    EXPECT_NE(
        page.find("http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:;"),
        std::string::npos);
    for (const char* part :
         {"src=\"http", "href=\"http", "url(h", "@import", "<link", "'unsafe-inline'", "'unsafe-eval'"})
        EXPECT_EQ(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("{{"), std::string::npos);
}

TEST(ReportPage, IsTheSameForTheSameRows) {
    EXPECT_EQ(report_page(some_results(), {}), report_page(some_results(), {}));
}

TEST(ReportPage, HostileTextsStayText) {
    const std::string script = "</script></style><script>alert(1)</script><!--{{nonce}}";
    Json row = to_json(result_row("lss", 1, 90, 0.3));
    for (const auto& [object, key] : {std::pair("model", "name"),
                                      {"model", "spec"},
                                      {"rays", "name"},
                                      {"device", "name"},
                                      {"device", "driver"},
                                      {"primitive", "label"},
                                      {"primitive", "name"},
                                      {"device", "class"},
                                      {"context", "cpu"},
                                      {"context", "commit"},
                                      {"context", "time"},
                                      {"time", "warning"}})
        row[object][key] = script;
    row["reproduce"] = script + "\"'`\\";
    MergedResults results = results_of({row});
    results.missing = {script};
    results.silent_shards = {script};
    results.stress = {
        Json{{"family", script}, {"primitive", script}, {"device", script}, {"verdict", script}}};
    PageOptions options;
    options.title = script;
    const std::string page = report_page(results, options);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
    EXPECT_EQ(page.find("</script></style>"), std::string::npos);
    // Nobody's text was searched for names of the template.
    const std::string nonce = between(page, "script-src 'nonce-", "'");
    EXPECT_EQ(nonce.size(), 16u);
    EXPECT_EQ(page.find("<!--" + nonce), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(1)"), std::string::npos);
    const Json table = table_of(page);
    EXPECT_EQ(table["warnings"]["texts"][0], script);
    std::string command;
    for (const Json& word : table["reproduce"]["commands"][0])
        command +=
            (command.empty() ? "" : " ") + table["reproduce"]["words"][word.get<size_t>()].get<std::string>();
    EXPECT_EQ(command, script + "\"'`\\");
}

TEST(ReportPage, NamesWhatIsMissing) {
    MergedResults results = some_results();
    results.missing = {"curly 640x360 primary lss"};
    results.silent_shards = {"shard 3 of 4 of sweep aa"};
    const std::string page = report_page(results, {});
    EXPECT_NE(page.find("1 cases of the sweep are missing: curly 640x360 primary lss."), std::string::npos);
    EXPECT_NE(page.find("No row came from shard 3 of 4 of sweep aa."), std::string::npos);
}

TEST(ReportPage, TheTableHasEveryRow) {
    const Json table = table_of(report_page(some_results(), {}));
    EXPECT_EQ(table["rows"], 3);
    for (const Json& column : table["columns"]) {
        ASSERT_EQ(column["values"].size(), 3u);
        if (column["heading"] == "trace") {
            EXPECT_EQ(column["values"], Json({1.0, 2.0, 3.0}));
        }
        if (column["heading"] == "primitive") {
            EXPECT_EQ(column["texts"].size(), 3u);
        }
    }
    EXPECT_EQ(table["fronts"][0].get<int>() & 1, 1);
}

TEST(ReportPage, TheTableHasWhatSomeRowsHave) {
    const auto has_column = [](const Json& table, const char* heading) {
        return std::any_of(table["columns"].begin(), table["columns"].end(),
                           [&](const Json& column) { return column["heading"] == heading; });
    };
    const Json without = table_of(report_page(some_results(), {}));
    MergedResults results = some_results();
    results.rows[1]["profile"] = {{"trace_ms", 4}, {"floor_ms", 1}, {"work", {{"leaves_per_ray", 7.5}}}};
    results.rows[2]["distances"] = {{{"scale", 2}, {"flip", 0.5}}, {{"scale", 1}, {"flip", 0.25}}};
    const Json table = table_of(report_page(results, {}));
    for (const char* heading : {"leaves", "floor", "FLIP"}) {
        EXPECT_FALSE(has_column(without, heading)) << heading;
        EXPECT_TRUE(has_column(table, heading)) << heading;
    }
    for (const Json& column : table["columns"]) {
        if (column["heading"] == "leaves") {
            EXPECT_EQ(column["values"], Json({nullptr, 7.5, nullptr}));
        }
        if (column["heading"] == "floor") {
            EXPECT_EQ(column["values"], Json({nullptr, 0.25, nullptr}));
        }
        if (column["heading"] == "FLIP") {
            EXPECT_EQ(column["values"], Json({nullptr, nullptr, 0.25}));
        }
    }
}

TEST(ReportPage, PicturesAreInsideAndOnlyPictures) {
    const TestFolder folder;
    const std::string png = "\x89PNG\r\n\x1a\nwhatever";
    write_file(folder / "a.png", png);
    write_file(folder / "b.png", "<script>alert(1)</script>");
    Json row = to_json(result_row("lss", 1, 90, 0.3));
    row["folder"] = folder / ".";
    row["images"] = {
        {"rendered", "a.png"}, {"error_map", "b.png"}, {"reference", "none.png"}, {"difference", 3}};
    const std::string page = report_page(results_of({row}), {});
    const Json pictures = Json::parse(between(page, "id=\"picture-data\">", "</script>"));
    ASSERT_EQ(pictures["list"].size(), 1u);
    EXPECT_EQ(pictures["list"][0]["kind"], "rendered");
    EXPECT_EQ(pictures["uris"].size(), 1u);
    PageOptions without;
    without.pictures = false;
    EXPECT_EQ(report_page(results_of({row}), without).find("data:image"), std::string::npos);
}

TEST(ReportPage, FiguresAreFilesOfTheirOwn) {
    const TestFolder folder;
    const size_t count = write_figures(some_results(), folder / "figures");
    EXPECT_EQ(count, 8u);
    size_t seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "figures")) {
        const std::string svg = read_file(entry.path().string());
        EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << entry.path();
        EXPECT_NE(svg.find(".chart .grid"), std::string::npos);
        ++seen;
    }
    EXPECT_EQ(seen, count);
    EXPECT_TRUE(std::filesystem::exists(folder / "figures/tuft.primary_rays.llvmpipe.time-error.svg"));
}

TEST(ReportPage, NamesOfFiguresLeadNowhereElse) {
    const TestFolder folder;
    Json row = to_json(result_row("lss", 1, 90, 0.3));
    row["model"]["name"] = "../../escape/\n";
    row["rays"]["name"] = "..";
    write_figures(results_of({row}), folder / "figures");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "."))
        if (entry.is_regular_file()) {
            EXPECT_EQ(entry.path().parent_path().filename(), "figures");
        }
}

TEST(ReportPage, ManyRowsMakeASmallPage) {
    const size_t scenes = std::getenv("STRANDLAB_LONG_TESTS") ? 200 : 20;
    std::vector<Json> rows;
    for (size_t scene = 0; scene < scenes; ++scene)
        for (int i = 1; i <= 50; ++i) {
            Json row = to_json(result_row(fmt::format("lss:segments={}", i), i, 60 * i, 1.0 / (i * i)));
            row["model"]["name"] = fmt::format("scene {}", scene);
            row["key"] = fmt::format("{} {}", scene, i);
            row["reproduce"] = fmt::format(
                "strandlab bench 'scene {}' --rays primary --resolution 1920x1080 --repeat 10 --primitive "
                "lss:segments={}",
                scene, i);
            rows.push_back(std::move(row));
        }
    const size_t fixed = report_page(some_results(), {}).size();
    const std::string page = report_page(results_of(std::move(rows)), {});
    EXPECT_NE(page.find("class=\"packed\""), std::string::npos);
    EXPECT_LT(page.size(), fixed + 500 * 50 * scenes);
}

}  // namespace
}  // namespace strandlab::testing_tools
