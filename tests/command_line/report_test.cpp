// The page and the figures that come of result files.
#include "command_line/program.h"

namespace strandlab::testing_tools {
namespace {

class ReportTest : public CommandLineTest {
  protected:
    /// Rows of two primitives on the processor.
    void write_rows(const std::string& name) const {
        expect_success(run({"bench", "generate:fur,strands=60", "--resolution", "40x24", "--repeat", "2",
                            "--device", "cpu-float", "--rays", "primary", "--primitive", "lss", "--primitive",
                            "prhi", "--no-embree", "--json", name}));
    }
};

TEST_F(ReportTest, MakesAPageAndFiguresOfRealRows) {
    write_rows("a.jsonl");
    const Outcome outcome = run({"report", "a.jsonl", "-o", "page.html", "--figures", "deep/figures"});
    expect_success(outcome);
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.log.find("page.html: 2 rows"), std::string::npos) << outcome.log;
    const std::string page = read("page.html");
    EXPECT_TRUE(page.starts_with("<!doctype html>"));
    for (const char* part : {"What to use when", "lss", "prhi", "</html>"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_FALSE(exists("deep/figures/stress.heat-map.svg"));
    EXPECT_NE(read("deep/figures/fur_strands=60.primary_rays.cpu-float.time-error.svg").find("</svg>"),
              std::string::npos);
}

TEST_F(ReportTest, MergesFilesAndCountsWhatWasReplaced) {
    write_rows("a.jsonl");
    expect_success(
        run({"report", "a.jsonl", "a.jsonl", "--title", "Twice <the> same", "-o", "page.html", "--quiet"}));
    const std::string page = read("page.html");
    EXPECT_NE(page.find("2 rows were replaced"), std::string::npos);
    EXPECT_NE(page.find("<h1>Twice &lt;the&gt; same</h1>"), std::string::npos);
}

TEST_F(ReportTest, TakesStressBesideRows) {
    expect_success(run({"stress", "--device", "cpu-float", "--primitive", "lss", "--family", "gentle",
                        "--pairs", "50", "--json", "s.jsonl", "--heat-map", "heat.svg", "--quiet"}));
    EXPECT_NE(read("heat.svg").find("gentle"), std::string::npos);
    expect_success(run({"report", "s.jsonl", "-o", "page.html", "--figures", "figures"}));
    EXPECT_NE(read("page.html").find("Hard pairs of ray and strand"), std::string::npos);
    EXPECT_EQ(read("figures/stress.heat-map.svg"), read("heat.svg"));
}

TEST_F(ReportTest, BadInputIsOneLine) {
    write("empty.jsonl", "");
    write("other.jsonl", "{\"a\":1}\n");
    write("text.jsonl", "hello\n");
    expect_failure(run({"report", "nowhere.jsonl"}), 5, {"nowhere.jsonl", "cannot open"});
    expect_failure(run({"report", "empty.jsonl"}), 5, {"empty.jsonl", "no rows", "bench --json"});
    expect_failure(run({"report", "other.jsonl"}), 5, {"other.jsonl: line 1", "neither bench nor stress"});
    expect_failure(run({"report", "text.jsonl"}), 5, {"text.jsonl", "line 1"});
    expect_failure(run({"report"}), 2, {"files"});
    EXPECT_FALSE(exists("report.html"));
    write_rows("a.jsonl");
    expect_failure(run({"report", "a.jsonl", "-o", "no/page.html"}), 5, {"no/page.html"});
    expect_last_line(run({"report", "a.jsonl", "--figures", "a.jsonl/figures"}), 5, {"a.jsonl/figures"});
}

}  // namespace
}  // namespace strandlab::testing_tools
