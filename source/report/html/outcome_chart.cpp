// Which rays are wrong, and how.
#include "report/html/charts.h"
#include "report/html/stacked_bars.h"
#include "report/row_fields.h"

#include <nlohmann/json.hpp>

#include <array>

namespace strandlab {

std::optional<Drawing> outcome_chart(const ChartRows& data, const RowGroup& group) {
    StackedBars chart{"Wrong rays: " + group.title(),
                      "of the rays that meet hair, wrong, %",
                      {{"o0", "false miss"},
                       {"o1", "false hit"},
                       {"o2", "other strand"},
                       {"o3", "other place"},
                       {"o4", "NaN"}},
                      {}};
    constexpr std::array outcomes{"false_miss", "false_hit", "wrong_strand", "wrong_place", "nan"};
    for (const size_t i : group.all()) {
        const nlohmann::ordered_json& row = data.rows[i];
        const double met = number_or_nan(row, "model_error.all.rays") -
                           number_at(row, "model_error.all.agreed_misses").value_or(0);
        StackedBar bar{i, row_label(row), {}, 0, data.marks[i].any()};
        for (const char* outcome : outcomes)
            bar.sizes.push_back(
                100 * number_or_nan(row, std::string("model_error.all.") + outcome + ".count") / met);
        bar.figure = bar.total();
        chart.bars.push_back(std::move(bar));
    }
    return chart.has_bars() ? std::optional(chart.draw()) : std::nullopt;
}

}  // namespace strandlab
