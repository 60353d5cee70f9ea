// Cost against size: the fit, and what is drawn.
#include "report/scale_table.h"

#include "report/html/scale_chart.h"
#include "report/result_json.h"
#include "support/result_rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

using Points = std::vector<std::pair<double, double>>;

TEST(ScaleTable, FitsPowers) {
    EXPECT_NEAR(*fitted_exponent(Points{{10, 3}, {100, 30}, {1000, 300}}), 1, 1e-12);
    EXPECT_NEAR(*fitted_exponent(Points{{10, 7}, {1000, 70}}), 0.5, 1e-12);
    EXPECT_NEAR(*fitted_exponent(Points{{1, 5}, {1e7, 5}}), 0, 1e-12);
    EXPECT_NEAR(*fitted_exponent(Points{{10, 3}, {100, 30}, {1000, 0}, {1e4, NAN}}), 1, 1e-12);
    EXPECT_FALSE(fitted_exponent(Points{{10, 3}}));
    EXPECT_FALSE(fitted_exponent(Points{{10, 3}, {10, 4}}));
    EXPECT_FALSE(fitted_exponent(Points{}));
}

TEST(ScaleTable, OneLineForEachPrimitive) {
    std::vector<nlohmann::ordered_json> rows;
    for (const size_t curves : {100'000, 1'000, 10'000})
        for (const char* name : {"prhi", "lss"}) {
            ResultRow row = testing_tools::result_row(name, double(curves) / 100, 100, 0.1);
            row.model.curves = curves;
            rows.push_back(to_json(row));
        }
    const std::vector<ScaleSeries> series = scale_series(rows);
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[0].primitive, "prhi");
    EXPECT_EQ(series[0].rows, (std::vector<size_t>{2, 4, 0}));
    rows[2]["time"]["order_cached"] = true;  // read, not measured
    EXPECT_EQ(scale_points(rows, series[0], {"trace", "time.trace_ms.median"}).size(), 3u);
    rows[4]["time"]["order_ms"] = 7;
    rows[2]["time"]["order_ms"] = 7;
    EXPECT_EQ(scale_points(rows, series[0], {"order", "time.order_ms"}).size(), 1u);
    const std::string table = scale_table(rows);
    EXPECT_NE(table.find("1,000"), std::string::npos);
    EXPECT_NE(table.find("1.00"), std::string::npos) << table;  // of the trace times
    const std::string chart = scale_chart(rows);
    EXPECT_NE(chart.find("<svg"), std::string::npos);
    EXPECT_NE(chart.find("prhi, primary"), std::string::npos);
    EXPECT_EQ(scale_chart({}), "");
    EXPECT_EQ(scale_table({}), "");
}

}  // namespace
}  // namespace strandlab
