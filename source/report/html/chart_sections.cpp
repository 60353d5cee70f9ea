// The charts of each group, in panels that the page's filters choose from.
#include "report/html/markup.h"
#include "report/html/sections.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <set>

namespace strandlab {
namespace {

std::string inside_page(const std::optional<Drawing>& drawing) {
    return drawing ? drawing->inside_page() : "";
}

/// A panel with a heading; rays are left out where a chart does not depend on them.
std::string panel(const RowGroup& group, bool with_rays, const std::string& charts) {
    const std::string rays = with_rays ? escape_markup(group.rays) + ", " : "";
    return fmt::format(
        "<article class=\"panel\" data-scene=\"{0}\"{1} data-device=\"{2}\"><h3>{6} <small>{3}{2}, {4} "
        "traversal</small></h3>\n{5}</article>\n",
        escape_markup(group.scene),
        with_rays ? fmt::format(" data-rays=\"{}\"", escape_markup(group.rays)) : "",
        escape_markup(group.device), rays, escape_markup(group.device_class), charts,
        scene_markup(group.scene));
}

std::string charts_in(const char* style, const std::string& charts) {
    return charts.empty() ? "" : fmt::format("<div class=\"{}\">{}</div>\n", style, charts);
}

}  // namespace

std::string tradeoff_section(const PageData& data) {
    const ChartRows rows = data.charts();
    std::string html;
    for (const RowGroup& group : data.groups) {
        const auto chart = [&](Cost cost, ErrorKind error) {
            return inside_page(pareto_chart(rows, group, cost, error));
        };
        const std::string wrong = chart(Cost::time, ErrorKind::wrong) + chart(Cost::memory, ErrorKind::wrong);
        // Where only hit or miss counts there is no distance.
        const std::string distance = group.hit_or_miss_only ? ""
                                                            : chart(Cost::time, ErrorKind::distance) +
                                                                  chart(Cost::memory, ErrorKind::distance);
        const std::string charts =
            distance.empty() ? charts_in("pair", wrong)
                             : charts_in("pair by-distance", distance) + charts_in("pair by-wrong", wrong);
        if (!charts.empty()) html += panel(group, true, charts);
    }
    return html;
}

std::string memory_section(const PageData& data) {
    std::string html;
    std::set<std::pair<std::string, std::string>> drawn;
    for (const RowGroup& group : data.groups)
        if (drawn.emplace(group.scene, group.device).second)
            if (const auto chart = memory_chart(data.charts(), group))
                html += panel(group, false, chart->inside_page());
    return html;
}

std::string error_section(const PageData& data) {
    const ChartRows rows = data.charts();
    std::string html;
    for (const RowGroup& group : data.groups) {
        const std::string charts =
            charts_in("single", inside_page(outcome_chart(rows, group))) +
            charts_in("pair", inside_page(exceedance_chart(rows, group, Against::curves)) +
                                  inside_page(exceedance_chart(rows, group, Against::own_surface))) +
            charts_in("pair", inside_page(histogram_chart(rows, group, Against::curves)) +
                                  inside_page(histogram_chart(rows, group, Against::own_surface)));
        if (!charts.empty()) html += panel(group, true, charts);
    }
    return html;
}

std::string distance_section(const PageData& data) {
    std::string html;
    for (const RowGroup& group : data.groups) {
        std::string charts;
        for (const auto& [figure, title] : distance_figures)
            charts +=
                inside_page(distance_chart(data.charts(), group, std::string(figure), std::string(title)));
        if (!charts.empty()) html += panel(group, true, charts_in("pair", charts));
    }
    return html;
}

std::string stress_section(const PageData& data) {
    const auto chart = stress_chart(data.results.stress);
    return chart ? "<div class=\"scroll card heat\">" + chart->inside_page() + "</div>\n" : "";
}

}  // namespace strandlab
