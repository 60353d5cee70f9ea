#include "report/html/page.h"

#include "base/build_info.h"
#include "base/hash.h"
#include "report/html/markup.h"
#include "report/html/packed.h"
#include "report/html/resources.h"
#include "report/html/sections.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <set>

namespace strandlab {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

std::string plural(size_t count, const char* noun) {
    return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

/// "84 rows, 3 scenes, 2 devices; measured 2025-01-31 to 2025-02-01".
std::string summary_line(const PageData& data) {
    std::set<std::string> scenes, devices, days;
    for (const RowGroup& group : data.groups) scenes.insert(group.scene), devices.insert(group.device);
    for (const auto& row : data.results.rows)
        if (const std::string time = text_at(row, "context.time"); time.size() >= 10)
            days.insert(time.substr(0, 10));
    std::string text = fmt::format("{}, {}, {}", plural(data.results.rows.size(), "row"),
                                   plural(scenes.size(), "scene"), plural(devices.size(), "device"));
    if (!days.empty())
        text += "; measured " + *days.begin() + (days.size() > 1 ? " to " + *days.rbegin() : "");
    return text;
}

/// A section of the page; none where it would be empty.
std::string section(const std::string& name, const std::string& content) {
    if (content.empty()) return "";
    return filled_template(resource(name + ".html"), {{"content", content}});
}

/// Unlike anything that a row can say: whoever wants a script to run would have to know a hash of it.
std::string nonce_of(const Values& values) {
    Hash hash;
    for (const auto& [name, value] : values) hash.add(value.data(), value.size());
    return fmt::format("{:016x}", hash.value());
}

}  // namespace

PageData::PageData(const MergedResults& merged)
    : results(merged), marks(pareto_fronts(merged.rows)), groups(row_groups(merged.rows)) {}

ChartRows PageData::charts() const { return {results.rows, marks}; }

std::string filled_template(std::string_view text, const Values& values) {
    std::string result;
    for (size_t begin; (begin = text.find("{{")) != std::string_view::npos;) {
        const size_t end = text.find("}}", begin);
        assert(end != std::string_view::npos);
        const std::string_view name = text.substr(begin + 2, end - begin - 2);
        const auto value =
            std::find_if(values.begin(), values.end(), [&](const auto& one) { return one.first == name; });
        assert(value != values.end());
        result += text.substr(0, begin);
        result += value->second;
        text.remove_prefix(end + 2);
    }
    return result += text;
}

std::string report_page(const MergedResults& results, const PageOptions& options) {
    const PageData data(results);
    const std::string pictures = options.pictures ? picture_section(data) : "";
    Values values{
        {"title", escape_markup(options.title)},
        {"summary", escape_markup(summary_line(data))},
        {"version", escape_markup(build_info().version)},
        {"notes", notes_section(data)},
        {"marks", mark_definitions()},
        {"words", section("words", words_section(data))},
        {"tradeoffs", section("tradeoffs", markup_or_packed(tradeoff_section(data)))},
        {"memory", section("memory", markup_or_packed(memory_section(data)))},
        {"errors", section("errors", markup_or_packed(error_section(data)))},
        {"distances", section("distances", markup_or_packed(distance_section(data)))},
        {"stress", section("stress", stress_section(data))},
        {"pictures", pictures.empty() ? "" : std::string(resource("pictures.html"))},
        {"context", section("context", context_section(data))},
        {"table_data", data_element("table-data", table_data(data))},
        {"picture_data", data_element("picture-data", pictures.empty() ? "null" : pictures)},
    };
    values.emplace_back("nonce", nonce_of(values));
    for (const char* name : {"page.css", "chart.css", "d3_licence.txt", "d3.js", "page.js"})
        values.emplace_back(name, resource(name));
    return filled_template(resource("page.html"), values);
}

}  // namespace strandlab
