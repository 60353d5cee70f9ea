// Bytes per curve, by what they are for.
#include "report/html/charts.h"
#include "report/html/stacked_bars.h"
#include "report/row_fields.h"

#include <nlohmann/json.hpp>

namespace strandlab {

std::optional<Drawing> memory_chart(const ChartRows& data, const RowGroup& group) {
    StackedBars chart{"Memory: " + group.title(),
                      "bytes per curve (the figure: what stays while tracing)",
                      {{"b0", "acceleration structure"}, {"b1", "records"}, {"b2", "build input (freed)"}},
                      {}};
    for (const size_t i : group.all()) {
        const nlohmann::ordered_json& row = data.rows[i];
        const double curves = number_or_nan(row, "model.curves");
        const auto bytes = [&](const char* path) { return number_or_nan(row, path) / curves; };
        const double kept = bytes("memory.kept_bytes"), records = bytes("memory.record_bytes");
        chart.bars.push_back({i,
                              row_label(row),
                              {kept, records, bytes("memory.input_bytes")},
                              kept + records,
                              data.marks[i].any()});
    }
    return chart.has_bars() ? std::optional(chart.draw()) : std::nullopt;
}

}  // namespace strandlab
