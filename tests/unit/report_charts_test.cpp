#include "report/html/axis.h"
#include "report/html/charts.h"
#include "report/html/error_bins.h"
#include "report/html/markup.h"
#include "unit/support/result_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
    std::vector<std::string> all;
    for (const Tick& tick : ticks) all.push_back(tick.label);
    return all;
}

size_t count(const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
}

TEST(Axis, LogarithmicAxesEndAtRoundFigures) {
    const LogAxis axis(std::vector{0.03, 0.4, 7.0}, 100, 300);
    EXPECT_DOUBLE_EQ(axis.low(), 0.02);
    EXPECT_DOUBLE_EQ(axis.high(), 10);
    EXPECT_DOUBLE_EQ(axis.at(0.02), 100);
    EXPECT_DOUBLE_EQ(axis.at(10), 300);
    EXPECT_EQ(labels(axis.ticks(9)),
              (std::vector<std::string>{"0.02", "0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10"}));
    EXPECT_EQ(labels(axis.ticks(8)), (std::vector<std::string>{"0.1", "1", "10"}));
}

TEST(Axis, AnyValuesHaveAnAxis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& values : {std::vector<double>{},
                                              {0, -1, infinity, std::nan("")},
                                              {5e-324},
                                              {1e-300},
                                              {3},
                                              {9.99999, 10.00001},
                                              {1e300, 1e308},
                                              {1e-299, 1e307}}) {
        const LogAxis axis(values, 0, 100);
        ASSERT_GT(axis.low(), 0);
        ASSERT_GE(axis.high(), 9.9 * axis.low());
        for (const double value : values)
            if (value > 1e-300 && value < 1e300) {
                EXPECT_GE(axis.at(value), -1e-6) << value;
                EXPECT_LE(axis.at(value), 100 + 1e-6) << value;
            }
        for (const size_t most : {3u, 7u}) {
            const auto ticks = axis.ticks(most);
            EXPECT_LE(ticks.size(), most);
            EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end(),
                                       [](const Tick& a, const Tick& b) { return a.value < b.value; }));
        }
    }
}

TEST(Axis, DoublingAxesHaveTicksAtPowersOfTwo) {
    const LogAxis axis = LogAxis::doubling(1, 32, 0, 100);
    EXPECT_DOUBLE_EQ(axis.at(1), 0);
    EXPECT_DOUBLE_EQ(axis.at(32), 100);
    EXPECT_DOUBLE_EQ(axis.at(2), 20);
    EXPECT_EQ(labels(axis.ticks(7)), (std::vector<std::string>{"1", "2", "4", "8", "16", "32"}));
    EXPECT_LE(LogAxis::doubling(1e-6, 1e6, 0, 100).ticks(7).size(), 7u);
}

TEST(Axis, LinearAxesHaveFewTicks) {
    const LinearAxis axis(2048, 0, 100);
    EXPECT_EQ(labels(axis.ticks()), (std::vector<std::string>{"0", "500", "1000", "1500", "2000"}));
    for (const double highest : {0.0, -1.0, std::nan(""), 1e-12, 0.1, 7.0, 1e12}) {
        const auto ticks = LinearAxis(highest, 0, 100).ticks();
        EXPECT_GE(ticks.size(), 2u) << highest;
        EXPECT_LE(ticks.size(), 6u) << highest;
    }
}

TEST(Axis, LabelsAreShort) {
    EXPECT_EQ(tick_label(0), "0");
    EXPECT_EQ(tick_label(0.001), "0.001");
    EXPECT_EQ(tick_label(5000), "5000");
    EXPECT_EQ(tick_label(1e-5), "10⁻⁵");
    EXPECT_EQ(tick_label(2e12), "2×10¹²");
}

TEST(Markup, TextIsNeverMarkup) {
    EXPECT_EQ(escape_markup("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
    EXPECT_EQ(escape_markup("h\xC3\xA4"
                            "r \xF0\x9F\x92\x87"),
              "h\xC3\xA4"
              "r \xF0\x9F\x92\x87");
    const std::string unknown = "\xEF\xBF\xBD";
    for (const std::string& bad : {std::string("\x80"), std::string("\xC0\xAF"), std::string("\xED\xA0\x80"),
                                   std::string("\xF5\x80\x80\x80")})
        EXPECT_EQ(escape_markup("a" + bad + "b").substr(0, 1 + unknown.size()), "a" + unknown) << bad.size();
    EXPECT_EQ(escape_markup(std::string("a\0b\x1B", 4)), "a" + unknown + "b" + unknown);
    EXPECT_EQ(escape_markup("\xE2\x82"), unknown + unknown);
    EXPECT_EQ(escape_script("{\"a\":\"</script><!--\"}"), "{\"a\":\"\\u003c/script>\\u003c!--\"}");
}

TEST(Markup, ScenesSetTheirParametersApart) {
    EXPECT_EQ(scene_markup("bob,strands=9,points=3"), "bob <small>strands=9, points=3</small>");
    EXPECT_EQ(scene_markup("<b>"), "&lt;b&gt;");
    EXPECT_EQ(scene_markup("a,<b>"), "a <small>&lt;b&gt;</small>");
}

TEST(Markup, DataUrisAreBase64) {
    EXPECT_EQ(data_uri("image/png", "Man"), "data:image/png;base64,TWFu");
    EXPECT_EQ(data_uri("a/b", "Ma"), "data:a/b;base64,TWE=");
    EXPECT_EQ(data_uri("a/b", "M"), "data:a/b;base64,TQ==");
    EXPECT_EQ(data_uri("a/b", "\xFF\xFE\xFD"), "data:a/b;base64,//79");
    EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
}

class ChartsTest : public testing::Test {
  protected:
    void use(std::vector<Json> rows) {
        rows_ = std::move(rows);
        marks_ = pareto_fronts(rows_);
        groups_ = row_groups(rows_);
    }
    ChartRows data() const { return {rows_, marks_}; }

    std::vector<Json> rows_;
    std::vector<FrontMarks> marks_;
    std::vector<RowGroup> groups_;
};

TEST_F(ChartsTest, TheFrontIsFilledAndNamed) {
    use({to_json(result_row("lss", 1, 90, 0.3)), to_json(result_row("prhi", 2, 80, 0.1)),
         to_json(result_row("dots", 3, 70, 0.4))});
    ASSERT_EQ(groups_.size(), 1u);
    const std::string svg = pareto_chart(data(), groups_[0], Cost::time, ErrorKind::distance)->inside_page();
    EXPECT_EQ(count(svg, "<g class=\"p f "), 2u);
    EXPECT_EQ(count(svg, "<g class=\"p s"), 1u);
    EXPECT_EQ(count(svg, "class=\"name\""), 2u);
    EXPECT_EQ(count(svg, "class=\"front\""), 1u);
    for (const char* row : {"data-r=\"0\"", "data-r=\"1\"", "data-r=\"2\""}) EXPECT_EQ(count(svg, row), 1u);
}

TEST_F(ChartsTest, ErrorsWithoutALogarithmLieInBands) {
    use({to_json(result_row("lss", 1, 90, 0.3, 50)), to_json(result_row("prhi", 2, 80, 0.1))});
    const auto chart = [&](ErrorKind kind) {
        return pareto_chart(data(), groups_[0], Cost::memory, kind)->inside_page();
    };
    EXPECT_EQ(count(chart(ErrorKind::distance), "class=\"band\""), 1u);
    EXPECT_NE(chart(ErrorKind::distance).find("&gt; 1 %"), std::string::npos);
    EXPECT_EQ(count(chart(ErrorKind::wrong), "class=\"band\""), 1u);
    EXPECT_EQ(count(chart(ErrorKind::wrong), "data-r="), 2u);
}

TEST_F(ChartsTest, SoftwareAndHardwareNeverShareAChart) {
    ResultRow hardware = result_row("lss", 1, 90, 0.3);
    hardware.device.hardware_traversal = true;
    use({to_json(result_row("lss", 1, 90, 0.3)), to_json(hardware)});
    ASSERT_EQ(groups_.size(), 2u);
    for (const RowGroup& group : groups_) EXPECT_EQ(group.members.size(), 1u);
}

TEST_F(ChartsTest, EmbreeStandsBesideTheDevicesOfItsMachine) {
    ResultRow embree = result_row("lss", 1, 90, 0.3), elsewhere = embree;
    embree.device.name = "processor";
    embree.device.driver = elsewhere.device.driver = "Embree 3.13.5";
    elsewhere.context.cpu = "another";
    elsewhere.device.name = "another";
    use({to_json(result_row("prhi", 2, 80, 0.1)), to_json(embree), to_json(elsewhere)});
    ASSERT_EQ(groups_.size(), 1u);
    EXPECT_EQ(groups_[0].opinions, std::vector<size_t>{1});
    EXPECT_EQ(groups_[0].all(), (std::vector<size_t>{0, 1}));
    EXPECT_FALSE(marks_[1].time_error);
}

TEST_F(ChartsTest, GroupsOfOneNameAreToldApart) {
    ResultRow large = result_row("lss", 1, 90, 0.3);
    large.rays.width = 80;
    large.rays.hash = 5;
    use({to_json(result_row("lss", 1, 90, 0.3)), to_json(large)});
    ASSERT_EQ(groups_.size(), 2u);
    EXPECT_EQ(groups_[0].rays, "primary rays, 40x25");
    EXPECT_EQ(groups_[1].rays, "primary rays, 80x25");
}

TEST_F(ChartsTest, HostileNamesStayText) {
    Json row = to_json(result_row("lss", 1, 90, 0.3));
    row["model"]["name"] = "</svg><script>alert(1)</script>";
    row["primitive"]["label"] = "\"/><img src=x onerror=alert(1)>";
    row["primitive"]["name"] = "'><b>";
    use({row, to_json(result_row("prhi", 2, 80, 0.1))});
    for (const RowGroup& group : groups_)
        for (const auto& chart :
             {pareto_chart(data(), group, Cost::time, ErrorKind::distance), memory_chart(data(), group),
              outcome_chart(data(), group), exceedance_chart(data(), group, Against::curves)}) {
            for (const std::string& svg : {chart->inside_page(), chart->file()})
                for (const char* tag : {"<script", "<img", "<b>", "</svg><"})
                    EXPECT_EQ(svg.find(tag), std::string::npos) << tag;
        }
}

TEST_F(ChartsTest, RowsWithoutFiguresHaveNoChart) {
    ResultRow empty = result_row("lss", 1, 90, 0.3);
    empty.trace_ms.clear();
    empty.cost.reset();
    empty.model_error.reset();
    empty.intersector_error.reset();
    use({to_json(empty)});
    ASSERT_EQ(groups_.size(), 1u);
    EXPECT_FALSE(pareto_chart(data(), groups_[0], Cost::time, ErrorKind::distance));
    EXPECT_FALSE(memory_chart(data(), groups_[0]));
    EXPECT_FALSE(outcome_chart(data(), groups_[0]));
    EXPECT_FALSE(exceedance_chart(data(), groups_[0], Against::own_surface));
    EXPECT_FALSE(histogram_chart(data(), groups_[0], Against::curves));
    EXPECT_FALSE(distance_chart(data(), groups_[0], "flip", "FLIP"));
    EXPECT_FALSE(stress_chart({}));
}

TEST_F(ChartsTest, MeasuredBinsAreDrawn) {
    ResultRow row = result_row("lss", 1, 90, 0.3);
    auto& decades = row.model_error->all.measures[0].decades;
    decades[6] = 400, decades[8] = 99, decades[9] = 1;  // from 1e-4, 1e-2 and 0.1
    use({to_json(row)});
    const auto bins = error_bins(rows_[0], Against::curves);
    ASSERT_TRUE(bins.has_value());
    EXPECT_DOUBLE_EQ((*bins)[6], 0.8);
    EXPECT_DOUBLE_EQ(lower_edge(6), 1e-4);
    EXPECT_FALSE(error_bins(rows_[0], Against::own_surface));
    EXPECT_FALSE(histogram_chart(data(), groups_[0], Against::own_surface));
    const std::string bars = histogram_chart(data(), groups_[0], Against::curves)->inside_page();
    const size_t bar = bars.find("<path class=\"bar s1\" d=\"");
    ASSERT_NE(bar, std::string::npos);
    EXPECT_EQ(count(bars.substr(bar, bars.find("/>", bar) - bar), "z"), 3u);  // 1e-3 is empty
    for (const char* edge : {"10⁻⁴", ">0.001<", ">0.01<", ">0.1<", ">1<"})
        EXPECT_EQ(count(bars, edge), 1u) << edge;
    // The shares beyond four edges, three percentiles and the largest.
    const std::string curve = exceedance_chart(data(), groups_[0], Against::curves)->inside_page();
    const size_t line = curve.find("<path class=\"line s1\" d=\"M");
    ASSERT_NE(line, std::string::npos);
    EXPECT_EQ(count(curve.substr(line, curve.find("/>", line) - line), "L"), 7u);
    // Bins of other programs are no bins.
    for (const Json& other :
         {Json({1, 2}), Json("x"), Json(std::vector<int>(14, -1)), Json(std::vector<int>(14, 0))}) {
        rows_[0]["model_error"]["all"]["distance"]["decades"] = other;
        EXPECT_FALSE(error_bins(rows_[0], Against::curves)) << other;
    }
}

TEST_F(ChartsTest, DistancesAndStressAreDrawnWhereRowsHaveThem) {
    Json row = to_json(result_row("lss", 1, 90, 0.3));
    row["distances"] = {
        {{"scale", 1}, {"flip", 0.01}}, {{"scale", 32}, {"flip", 0.2}}, {{"scale", 4}, {"flip", "nan"}}, 3};
    use({row});
    const std::string chart = distance_chart(data(), groups_[0], "flip", "FLIP")->inside_page();
    const size_t line = chart.find("<path class=\"line s1\" d=\"M");
    ASSERT_NE(line, std::string::npos);
    const std::string data = chart.substr(line, chart.find("/>", line) - line);
    EXPECT_EQ(count(data, "L"), 1u) << data;  // two points
    // A figure that is 0 has no place on the axis: words say so.
    Json exact = to_json(result_row("rocaps", 1, 90, 0.3));
    exact["distances"] = {{{"scale", 1}, {"flip", 0}}, {{"scale", 2}, {"flip", 0}}};
    use({row, exact});
    EXPECT_NE(distance_chart(this->data(), groups_[0], "flip", "FLIP")
                  ->inside_page()
                  .find("rocaps: 0 at every distance"),
              std::string::npos);
    use({exact});
    EXPECT_FALSE(distance_chart(this->data(), groups_[0], "flip", "FLIP"));
    const Json cell{{"family", "grazing"},
                    {"primitive", "lss"},
                    {"device", "cpu-float"},
                    {"decisive_hits", 900},
                    {"decisive_misses", 100},
                    {"nan_hits", 0},
                    {"false_hits", {{"count", 1}}},
                    {"false_misses", {{"count", 0}}},
                    {"wrong_places", {{"count", 0}}},
                    {"verdict", "FAILS"}};
    const std::string map = stress_chart(std::vector{cell})->inside_page();
    EXPECT_EQ(count(map, "cell fails e4"), 1u) << map;
    EXPECT_NE(map.find(">1.0e-03<"), std::string::npos);
}

}  // namespace
}  // namespace strandlab::testing_tools
