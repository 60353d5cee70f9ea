#include "report/choices.h"
#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// Radii that 99 % of the rays must stay within: what a picture forgives, and what a measurement does.
constexpr std::array limits{0.1, 0.01};

struct GroupChoices {
    const RowGroup* group = nullptr;
    std::array<Choices, limits.size()> within;
};

std::vector<GroupChoices> all_choices(const PageData& data) {
    std::vector<GroupChoices> all;
    for (const RowGroup& group : data.groups) {
        GroupChoices& choices = all.emplace_back();
        choices.group = &group;
        for (size_t i = 0; i < limits.size(); ++i)
            choices.within[i] = choose(data.results.rows, group.members, limits[i]);
    }
    return all;
}

std::string label_html(const Json& row, const std::string& label) {
    return fmt::format("<span class=\"primitive s{}\">{}</span>", series_of(row), escape_markup(label));
}

std::string error_text(const Json& row) {
    const RowError error = row_error(row);
    if (std::isnan(error.wrong_share)) return "error not measured";
    const std::string wrong = error.wrong_share > 0 ? percent(error.wrong_share) + " wrong" : "none wrong";
    return error.distance_p99 ? fmt::format("p99 {} r, {}", significant(*error.distance_p99, 2), wrong)
                              : wrong;
}

std::string time_text(const Json& row) { return significant(row_time(row)) + " ms"; }

std::string memory_text(const Json& row) {
    return significant(number_or_nan(row, "memory.bytes_per_curve")) + " B/curve";
}

std::string choice_cell(const PageData& data, const char* heading, const std::optional<size_t>& choice,
                        bool by_memory, std::span<const size_t> as_fast = {}) {
    std::string html = fmt::format("<td data-h=\"{}\">", escape_markup(heading));
    if (!choice) return html + "<span class=\"none\">none</span></td>";
    const Json& row = data.results.rows[*choice];
    html +=
        fmt::format("<button class=\"row-link\" data-r=\"{}\">{}</button><small><b>{}</b>, {}<br>{}</small>",
                    *choice, label_html(row, row_label(row)), by_memory ? memory_text(row) : time_text(row),
                    by_memory ? time_text(row) : memory_text(row), error_text(row));
    constexpr size_t shown = 2;
    if (!as_fast.empty()) {
        html += "<small>not told apart: ";
        for (size_t i = 0; i < std::min(shown, as_fast.size()); ++i)
            html += (i == 0 ? "" : ", ") + escape_markup(row_label(data.results.rows[as_fast[i]]));
        if (as_fast.size() > shown) html += fmt::format(", {} more", as_fast.size() - shown);
        html += "</small>";
    }
    return html + "</td>";
}

std::string table_row(const PageData& data, const GroupChoices& choices) {
    const RowGroup& group = *choices.group;
    std::string html = fmt::format("<tr><th scope=\"row\">{}<small>{}<br>{}, {}</small></th>",
                                   scene_markup(group.scene), escape_markup(group.rays),
                                   escape_markup(group.device), escape_markup(group.device_class));
    const Choices& loose = choices.within[0];
    html += choice_cell(data, "Fastest within 0.1 r", loose.fastest, false, loose.as_fast);
    html += choice_cell(data, "Smallest within 0.1 r", loose.smallest, true);
    if (group.hit_or_miss_only) {
        html += "<td class=\"none\" colspan=\"2\">hit or miss only: “within” means at most 1 % wrong</td>";
    } else {
        const Choices& tight = choices.within[1];
        html += choice_cell(data, "Fastest within 0.01 r", tight.fastest, false, tight.as_fast);
        html += choice_cell(data, "Smallest within 0.01 r", tight.smallest, true);
    }
    html += choice_cell(data, "Least error", loose.most_accurate, false);
    html += choice_cell(data, "Fastest of all", loose.fastest_of_all, false);
    return html + "</tr>\n";
}

/// "prhi in 3, lss:segments=8 in 1, none in 2".
std::string winners(const PageData& data, const std::vector<std::optional<size_t>>& choices) {
    std::map<std::string, size_t> counts;
    std::map<std::string, size_t> example;
    size_t none = 0;
    for (const auto& choice : choices) {
        if (!choice) {
            ++none;
            continue;
        }
        const std::string label = text_at(data.results.rows[*choice], "primitive.label");
        ++counts[label];
        example.emplace(label, *choice);
    }
    std::vector<std::pair<std::string, size_t>> order(counts.begin(), counts.end());
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    constexpr size_t shown = 4;
    std::string html;
    size_t others = 0;
    for (size_t i = 0; i < order.size(); ++i)
        if (i < shown)
            html += fmt::format("{}{} in {}", i == 0 ? "" : ", ",
                                label_html(data.results.rows[example[order[i].first]], order[i].first),
                                order[i].second);
        else
            others += order[i].second;
    if (others > 0) html += fmt::format(", others in {}", others);
    if (none > 0) html += fmt::format("{}none in {}", html.empty() ? "" : ", ", none);
    return html;
}

std::string device_words(const PageData& data, const std::vector<const GroupChoices*>& groups) {
    const RowGroup& first = *groups.front()->group;
    const auto sentence = [&](const std::string& what, auto&& pick) {
        std::vector<std::optional<size_t>> picked;
        for (const GroupChoices* one : groups) picked.push_back(pick(*one));
        return fmt::format("<li><b>{}</b>: {}.</li>\n", what, winners(data, picked));
    };
    std::string html = fmt::format("<h3>{} <small>{} traversal, {} {} of scene and rays</small></h3>\n<ul>\n",
                                   escape_markup(first.device), escape_markup(first.device_class),
                                   groups.size(), groups.size() == 1 ? "combination" : "combinations");
    html += sentence("Fastest with p99 ≤ 0.1 r", [](const GroupChoices& g) { return g.within[0].fastest; });
    html += sentence("Smallest with p99 ≤ 0.1 r", [](const GroupChoices& g) { return g.within[0].smallest; });
    html += sentence("Fastest with p99 ≤ 0.01 r", [](const GroupChoices& g) { return g.within[1].fastest; });
    html += sentence("Least error", [](const GroupChoices& g) { return g.within[0].most_accurate; });
    return html + "</ul>\n";
}

}  // namespace

std::string words_section(const PageData& data) {
    if (data.groups.empty()) return "";
    const std::vector<GroupChoices> all = all_choices(data);
    std::map<std::pair<std::string, std::string>, std::vector<const GroupChoices*>> devices;
    for (const GroupChoices& one : all) devices[{one.group->device_class, one.group->device}].push_back(&one);
    std::string html = "<div class=\"devices\">\n";
    for (const auto& [device, groups] : devices)
        html += "<div class=\"card\">\n" + device_words(data, groups) + "</div>\n";
    html +=
        "</div>\n<p class=\"hint\">“p99 ≤ 0.1 r”: of the rays that meet hair, at most 1 % hit or miss "
        "wrongly or "
        "meet another strand or place, and 99 % of the right hits lie within a tenth of the hair's radius of "
        "the "
        "exact swept curves. “Not told apart”: the 95 % intervals of the median times meet.</p>\n";
    html += fmt::format(
        "<details{}><summary>What to use when, scene by scene</summary>\n<div class=\"scroll\"><table "
        "class=\"choices\">\n<thead><tr><th>Scene</th><th>Fastest within 0.1 r</th><th>Smallest within 0.1 "
        "r</th><th>Fastest within 0.01 r</th><th>Smallest within 0.01 r</th><th>Least error</th><th>Fastest "
        "of "
        "all</th></tr></thead>\n<tbody>\n",
        all.size() <= 24 ? " open" : "");
    for (const GroupChoices& one : all) html += table_row(data, one);
    return html + "</tbody></table></div></details>\n";
}

}  // namespace strandlab
