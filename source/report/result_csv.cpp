#include "report/result_csv.h"

#include "report/result_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <functional>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string scalar_text(const Json& value) {
    if (value.is_null()) return "";
    return value.is_string() ? value.get<std::string>() : to_line(value);
}

std::string field_text(const Json& value) {
    std::string text;
    if (value.is_array())
        for (size_t i = 0; i < value.size(); ++i)
            text.append(i == 0 ? "" : ";").append(scalar_text(value[i]));
    else if (value.is_object())
        for (const auto& [key, item] : value.items())
            text.append(text.empty() ? "" : ",").append(key).append("=").append(scalar_text(item));
    else
        text = scalar_text(value);
    return text;
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

bool ends_with_any(std::string_view text, std::span<const std::string_view> ends) {
    return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return text.ends_with(end); });
}

/// Whether a value has a column.
bool is_column(std::string_view path) {
    constexpr std::array<std::string_view, 3> details{".first_ray", ".worst_ray", ".decades"};
    if (ends_with_any(path, details)) return false;
    const bool in_other_group = contains(path, "_error.all.") || contains(path, "_error.on_cap.") ||
                                contains(path, "_error.inside.") || contains(path, "_error.inside_own.");
    if (!in_other_group) return true;
    constexpr std::array<std::string_view, 6> counts{"nan.count",         "false_hit.count",
                                                     "false_miss.count",  "wrong_strand.count",
                                                     "wrong_place.count", ".rays"};
    return ends_with_any(path, counts);
}

bool is_list_of_objects(const Json& value) {
    return value.is_array() && !value.empty() &&
           std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_object(); });
}

/// The values of each key of objects that have the same keys.
Json transposed(const Json& list) {
    Json object;
    for (const Json& item : list)
        for (const auto& [key, value] : item.items()) object[key].push_back(value);
    return object;
}

/// Calls visit(path, value) for everything that is no object; parameters, whose keys differ from row to
/// row, count as one value, and a list of objects as one list for each of their keys.
void for_each_value(const Json& object, const std::string& prefix,
                    const std::function<void(const std::string&, const Json&)>& visit) {
    for (const auto& [key, value] : object.items()) {
        const std::string path = prefix.empty() ? key : prefix + "." + key;
        if (value.is_object() && key != "parameters")
            for_each_value(value, path, visit);
        else if (is_list_of_objects(value))
            for_each_value(transposed(value), path, visit);
        else
            visit(path, value);
    }
}

/// A row in which everything is measured, so that every column exists.
Json full_row() {
    ResultRow row;
    row.trace_ms = row.wall_ms = {1};
    row.ratio = {"", {1}};
    row.images = {"x", "x", "x"};
    row.distances.emplace_back();
    row.geometry_ms = 0;
    row.cost.emplace();
    row.profile.emplace();
    row.profile->shaders.emplace_back();
    row.profile->work = row.profile->work_at_hit = WorkCounts{.rays = 1, .leaves = 1};
    Comparison comparison;
    for (Tally* tally : {&comparison.decisive, &comparison.all, &comparison.on_cap, &comparison.inside,
                         &comparison.inside_own})
        for (Percentiles& percentiles : tally->measures) percentiles.count = 1;
    row.intersector_error = row.model_error = comparison;
    return to_json(row);
}

}  // namespace

std::string csv_field(std::string_view text) {
    const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                       (text.empty() || (text.front() != ' ' && text.back() != ' '));
    if (plain) return std::string(text);
    std::string field = "\"";
    for (const char c : text) field.append(c == '"' ? 2 : 1, c);
    field += '"';
    return field;
}

std::string csv_line(std::span<const std::string> fields) {
    std::string line;
    for (size_t i = 0; i < fields.size(); ++i) line.append(i == 0 ? "" : ",").append(csv_field(fields[i]));
    return line;
}

const std::vector<std::string>& csv_columns() {
    static const std::vector<std::string> columns = [] {
        std::vector<std::string> names;
        for_each_value(full_row(), "", [&](const std::string& path, const Json&) {
            if (is_column(path)) names.push_back(path);
        });
        return names;
    }();
    return columns;
}

std::vector<std::string> csv_fields(const Json& row) {
    std::vector<std::string> fields(csv_columns().size());
    size_t next = 0;
    // Rows have their keys in the order of the columns; a null leaves the columns below it empty.
    for_each_value(row, "", [&](const std::string& path, const Json& value) {
        const auto begin = csv_columns().begin() + static_cast<std::ptrdiff_t>(next);
        const auto column = std::find(begin, csv_columns().end(), path);
        if (column == csv_columns().end()) return;
        next = static_cast<size_t>(column - csv_columns().begin()) + 1;
        fields[next - 1] = field_text(value);
    });
    return fields;
}

}  // namespace strandlab
