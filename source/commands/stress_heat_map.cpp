// Family x primitive as a picture that any browser shows.
#include "commands/stress_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace strandlab {
namespace {

constexpr int cell_width = 96, cell_height = 18, left = 130, top = 56;

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    return result;
}

double error_rate(const StressTally& t) {
    const uint64_t decisive = t.hits + t.misses;
    const uint64_t wrong = t.false_hits + t.false_misses + t.wrong_hits + t.nan_hits;
    return decisive == 0 ? 0 : double(wrong) / double(decisive);
}

/// White without errors, darker with every decade from 1e-6 to 1; red where that is a failure.
std::string colour(const StressCell& cell) {
    const double rate = error_rate(cell.tally);
    const double dark = rate > 0 ? std::clamp((std::log10(rate) + 7) / 7, 0.1, 1.0) : 0;
    const auto shade = [&](double full) { return static_cast<int>(255 - dark * (255 - full)); };
    if (cell.judgement.verdict == StressVerdict::not_judged)
        return fmt::format("rgb({0},{0},{0})", std::min(235, shade(110)));
    const bool fails = cell.judgement.verdict == StressVerdict::fails;
    if (fails && rate == 0) return "rgb(255,225,190)";  // a percentile
    return fails ? fmt::format("rgb({},{},{})", shade(200), shade(30), shade(30))
                 : fmt::format("rgb({},{},{})", shade(90) - 20, shade(150), shade(90) - 20);
}

template <class Key>
std::vector<std::string> distinct(std::span<const StressCell> cells, Key key) {
    std::vector<std::string> all;
    for (const StressCell& cell : cells)
        if (std::find(all.begin(), all.end(), key(cell)) == all.end()) all.push_back(key(cell));
    return all;
}

size_t place_of(const std::vector<std::string>& all, const std::string& name) {
    return static_cast<size_t>(std::find(all.begin(), all.end(), name) - all.begin());
}

}  // namespace

std::string stress_heat_map(std::span<const StressCell> cells) {
    const auto row_of = [](const StressCell& c) { return c.family->name; };
    const auto column_of = [](const StressCell& c) {
        return c.label + "\n" + c.device.substr(0, c.device.find(" ("));
    };
    const auto rows = distinct(cells, row_of), columns = distinct(cells, column_of);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"sans-serif\" "
        "font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<text x=\"4\" y=\"14\">share of decisive rays judged wrong; red: beyond the documented figures, "
        "grey: "
        "not judged, orange: distances</text>\n",
        left + cell_width * static_cast<int>(columns.size()) + 4,
        top + cell_height * static_cast<int>(rows.size()) + 4);
    for (size_t i = 0; i < columns.size(); ++i) {
        const size_t cut = columns[i].find('\n');
        const int x = left + cell_width * static_cast<int>(i);
        svg += fmt::format("<text x=\"{}\" y=\"34\">{}</text><text x=\"{}\" y=\"48\">{}</text>\n", x,
                           escaped(columns[i].substr(0, cut)), x, escaped(columns[i].substr(cut + 1)));
    }
    for (size_t i = 0; i < rows.size(); ++i)
        svg += fmt::format("<text x=\"4\" y=\"{}\">{}</text>\n", top + cell_height * static_cast<int>(i) + 13,
                           escaped(rows[i]));
    for (const StressCell& cell : cells) {
        const int x = left + cell_width * static_cast<int>(place_of(columns, column_of(cell)));
        const int y = top + cell_height * static_cast<int>(place_of(rows, row_of(cell)));
        const double rate = error_rate(cell.tally);
        svg += fmt::format(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#ccc\"/>"
            "<text x=\"{}\" y=\"{}\">{}</text>\n",
            x, y, cell_width, cell_height, colour(cell), x + 4, y + 13,
            rate > 0 ? fmt::format("{:.1e}", rate) : "0");
    }
    return svg + "</svg>\n";
}

}  // namespace strandlab
