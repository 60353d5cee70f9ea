#include "report/table.h"

#include "report/comparison_text.h"
#include "report/text_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace strandlab {
namespace {

TEST(TextFormat, SignificantDigits) {
    EXPECT_EQ(significant(0), "0");
    EXPECT_EQ(significant(-0.0), "0");
    EXPECT_EQ(significant(1.23456), "1.23");
    EXPECT_EQ(significant(-1.23456), "-1.23");
    EXPECT_EQ(significant(9.996), "10.0");
    EXPECT_EQ(significant(123456), "123456");
    EXPECT_EQ(significant(999999.9, 3), "1.00e+06");
    EXPECT_EQ(significant(0.00123456), "0.00123");
    EXPECT_EQ(significant(0.000123456), "1.23e-04");
    EXPECT_EQ(significant(1.5, 1), "2");
    EXPECT_EQ(significant(std::nan("")), "nan");
    EXPECT_EQ(significant(-std::numeric_limits<double>::infinity()), "-inf");
    EXPECT_EQ(significant(std::numeric_limits<double>::denorm_min()), "4.94e-324");
}

TEST(TextFormat, CountsSizesAndShares) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1234567890123ull), "1,234,567,890,123");
    EXPECT_EQ(bytes_text(17), "17 B");
    EXPECT_EQ(bytes_text(1250), "1.25 kB");
    EXPECT_EQ(bytes_text(999'499), "999 kB");
    EXPECT_EQ(bytes_text(999'500), "1.00 MB");
    EXPECT_EQ(bytes_text(~uint64_t(0)), "18447 PB");
    EXPECT_EQ(percent(0.000128), "0.013 %");
    EXPECT_EQ(percent(1), "100 %");
    EXPECT_EQ(percent(0), "0 %");
}

Table example() {
    Table table({{.heading = "primitive", .text = true},
                 {"trace", "ms"},
                 {"memory", "MB"},
                 {.heading = "caps", .text = true}});
    table.add_row({"lss", "1.25", "64.0", "round"});
    table.add_row({"d\xC3\xB6ts", "10.5", "", "open"});
    table.add_row({"prhi"});
    return table;
}

TEST(Table, AlignsTextLeftAndNumbersRight) {
    EXPECT_EQ(example().to_string(),
              "primitive  trace  memory  caps\n"
              "              ms      MB\n"
              "---------  -----  ------  -----\n"
              "lss         1.25    64.0  round\n"
              "d\xC3\xB6ts        10.5          open\n"
              "prhi\n");
}

TEST(Table, WrapsColumnsBehindTheirKeys) {
    EXPECT_EQ(example().to_string({.width = 24}),
              "primitive  trace  memory\n"
              "              ms      MB\n"
              "---------  -----  ------\n"
              "lss         1.25    64.0\n"
              "d\xC3\xB6ts        10.5\n"
              "prhi\n"
              "\n"
              "primitive  caps\n"
              "\n"
              "---------  -----\n"
              "lss        round\n"
              "d\xC3\xB6ts       open\n"
              "prhi\n");
}

TEST(Table, LinesFitWhereverAColumnBesideItsKeyDoes) {
    for (int width = 19; width < 40; ++width) {
        std::istringstream text(example().to_string({.width = width}));
        for (std::string line; std::getline(text, line);)
            EXPECT_LE(display_width(line), static_cast<size_t>(width)) << line;
    }
    // Where it does not, every column is still there.
    EXPECT_NE(example().to_string({.width = 1}).find("64.0"), std::string::npos);
}

TEST(Table, BoldHeadingsOnlyWhenAskedFor) {
    EXPECT_EQ(example().to_string().find('\x1b'), std::string::npos);
    EXPECT_TRUE(
        example().to_string({.bold = true}).starts_with("\x1b[1mprimitive  trace  memory  caps\x1b[0m\n"));
}

TEST(Table, WithoutUnitsOrRows) {
    EXPECT_EQ(Table({{.heading = "a"}}).to_string(), "a\n-\n");
    EXPECT_EQ(Table({}).to_string().find_first_not_of('\n'), std::string::npos);
}

TEST(ComparisonText, CountsCarryTheirBounds) {
    EXPECT_EQ(count_text({0, 0}), "-");
    EXPECT_EQ(count_text({0, 100}), "0 of 100 (95 %: below 3.0 %)");
    EXPECT_EQ(count_text({100, 100}), "100 of 100 (95 %: above 97 %)");
    EXPECT_EQ(count_text({5, 10}), "5 of 10 (50 %, 95 %: 19 % to 81 %)");
}

TEST(ComparisonText, ShowsGroupsMeasuresAndVerdict) {
    Comparison comparison;
    comparison.margin = 0.2;
    comparison.all.rays = 4;
    comparison.decisive.rays = 3;
    comparison.decisive.measures[0] = {3, 0.1, 0.2, 0.3, 0.4, 0.5, 17};
    const std::string text = comparison_text(comparison, {});
    EXPECT_NE(text.find("decisive"), std::string::npos);
    EXPECT_EQ(text.find("on a cap"), std::string::npos);
    EXPECT_NE(text.find("distance  radius  0.100  0.200  0.300   0.400  0.500         17"), std::string::npos)
        << text;
    EXPECT_NE(text.find("undecided: 1 of 4 (25 %); radii scaled by 1 +- 0.200"), std::string::npos) << text;
    EXPECT_NE(text.find("no verdict"), std::string::npos);
    comparison.margin = 0.001;
    EXPECT_EQ(comparison_text(comparison, {}).find("no verdict"), std::string::npos);
}

}  // namespace
}  // namespace strandlab
