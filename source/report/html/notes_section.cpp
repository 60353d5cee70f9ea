#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <vector>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

template <class Condition>
size_t count_rows(const PageData& data, Condition condition) {
    return static_cast<size_t>(std::count_if(data.results.rows.begin(), data.results.rows.end(), condition));
}

std::string missing_text(const MergedResults& results) {
    constexpr size_t shown = 8;
    std::string text = fmt::format("{} cases of the sweep are missing", grouped(results.missing.size()));
    for (size_t i = 0; i < std::min(shown, results.missing.size()); ++i)
        text += (i == 0 ? ": " : "; ") + results.missing[i];
    if (results.missing.size() > shown)
        text += fmt::format("; and {} more", grouped(results.missing.size() - shown));
    return text + ".";
}

std::string silent_text(const MergedResults& results) {
    constexpr size_t shown = 8;
    std::string text = "No row came from ";
    for (size_t i = 0; i < std::min(shown, results.silent_shards.size()); ++i)
        text += (i == 0 ? "" : ", ") + results.silent_shards[i];
    if (results.silent_shards.size() > shown)
        text += fmt::format(" and {} more", results.silent_shards.size() - shown);
    return text + ".";
}

std::vector<std::string> warnings(const PageData& data) {
    const MergedResults& results = data.results;
    std::vector<std::string> texts;
    if (!results.missing.empty()) texts.push_back(missing_text(results));
    if (!results.silent_shards.empty()) texts.push_back(silent_text(results));
    std::set<std::string> commits;
    for (const Json& row : results.rows) commits.insert(text_at(row, "context.commit"));
    if (commits.size() > 1)
        texts.push_back(
            fmt::format("The rows come from {} versions of the program; see the context.", commits.size()));
    if (const size_t n =
            count_rows(data, [](const Json& row) { return is_true_at(row, "context.modified"); }))
        texts.push_back(
            fmt::format("{} rows come from a program whose sources differed from its commit.", grouped(n)));
    if (const size_t n =
            count_rows(data, [](const Json& row) { return is_true_at(row, "device.validation_layers"); }))
        texts.push_back(fmt::format(
            "{} rows were timed with validation layers on: their times are not comparable.", grouped(n)));
    if (const size_t n =
            count_rows(data, [](const Json& row) { return !text_at(row, "time.warning").empty(); }))
        texts.push_back(fmt::format(
            "{} rows have widely spread times; the column “± %” and their details say more.", grouped(n)));
    return texts;
}

}  // namespace

std::string notes_section(const PageData& data) {
    std::string html;
    for (const std::string& text : warnings(data))
        html += fmt::format("<li class=\"warning\">{}</li>\n", escape_markup(text));
    const bool software = std::any_of(data.groups.begin(), data.groups.end(),
                                      [](const RowGroup& group) { return group.device_class == "software"; });
    if (software)
        html +=
            "<li>Software traversal (lavapipe, and GPUs without ray-tracing hardware such as the H100) "
            "compares primitives with each other there; it says nothing about GPUs with ray-tracing "
            "hardware.</li>\n";
    if (data.results.replaced > 0)
        html += fmt::format("<li>{} rows were replaced by later rows of the same case.</li>\n",
                            grouped(data.results.replaced));
    return html.empty() ? "" : "<ul class=\"notes\">\n" + html + "</ul>\n";
}

}  // namespace strandlab
