// Family x primitive as a picture of its own: the chart that reports have.
#include "base/text.h"
#include "commands/stress_report.h"
#include "report/html/charts.h"

#include <nlohmann/json.hpp>

namespace strandlab {

std::string stress_heat_map(std::span<const StressCell> cells) {
    std::vector<nlohmann::ordered_json> rows;
    const std::string lines = stress_json(cells, 0, {});
    for (const std::string_view line : split(lines, '\n'))
        if (!line.empty()) rows.push_back(nlohmann::ordered_json::parse(line));
    const auto chart = stress_chart(rows);
    return chart ? chart->file() : "";
}

}  // namespace strandlab
