// Families of hard pairs x intersectors.
#include "report/html/charts.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

constexpr double cell_width = 104, cell_height = 20, left = 140, top = 58, key_size = 11;

/// Distinct texts in the order in which they come.
class Names {
  public:
    double place_of(const std::string& name) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found == names_.end()) names_.push_back(name);
        return static_cast<double>(found - names_.begin());
    }
    const std::vector<std::string>& all() const { return names_; }

  private:
    std::vector<std::string> names_;
};

double error_rate(const Json& cell) {
    const double decisive = number_or_nan(cell, "decisive_hits") + number_or_nan(cell, "decisive_misses");
    double wrong = number_or_nan(cell, "nan_hits");
    for (const char* kind : {"false_hits.count", "false_misses.count", "wrong_places.count"})
        wrong += number_or_nan(cell, kind);
    return decisive > 0 ? wrong / decisive : 0;
}

const char* verdict_style(const Json& cell) {
    const std::string verdict = text_at(cell, "verdict");
    return verdict == "holds" ? "holds" : verdict == "FAILS" ? "fails" : "open";
}

/// The decade of the rate: e0 none, e1 below 1e-5, ... e6 a tenth or more.
std::string decade_style(double rate) {
    if (!(rate > 0)) return "e0";
    return fmt::format("e{}", static_cast<int>(std::clamp(std::floor(std::log10(rate)) + 7, 1.0, 6.0)));
}

}  // namespace

std::optional<Drawing> stress_chart(std::span<const Json> cells) {
    if (cells.empty()) return std::nullopt;
    Names families, columns;
    const auto column_of = [](const Json& cell) {
        return text_at(cell, "primitive") + '\n' + short_device_name(text_at(cell, "device"));
    };
    for (const Json& cell : cells)
        families.place_of(text_at(cell, "family")), columns.place_of(column_of(cell));
    constexpr std::string_view key =
        "share of decisive rays answered wrongly; green holds what is documented, red does not, grey is not "
        "judged";
    const double width = std::max(left + cell_width * static_cast<double>(columns.all().size()) + 4,
                                  text_width(key, key_size) + 12);
    Drawing drawing(width, top + cell_height * static_cast<double>(families.all().size()) + 6,
                    "Wrong answers among decisive rays of hard families");
    drawing.text("key", 4, 14, key);
    for (const std::string& column : columns.all()) {
        const double x = left + cell_width * columns.place_of(column) + 4;
        const size_t cut = column.find('\n');
        drawing.text("name", x, 36, shortened(column.substr(0, cut), 17));
        drawing.text("tick", x, 50, shortened(column.substr(cut + 1), 17));
    }
    for (const std::string& family : families.all())
        drawing.text("name end", left - 6, top + cell_height * families.place_of(family) + 14, family);
    for (const Json& cell : cells) {
        const double x = left + cell_width * columns.place_of(column_of(cell));
        const double y = top + cell_height * families.place_of(text_at(cell, "family"));
        const double rate = error_rate(cell);
        const std::string decade = decade_style(rate);
        drawing.rectangle(fmt::format("cell {} {}", verdict_style(cell), decade), x + 1, y + 1,
                          cell_width - 2, cell_height - 2);
        drawing.text("in " + decade, x + 8, y + 14, rate > 0 ? fmt::format("{:.1e}", rate) : "0");
    }
    return drawing;
}

}  // namespace strandlab
