#include "report/words.h"

#include "report/choices.h"
#include "report/fronts.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string label_of(const Json& row) { return text_at(row, "primitive.label"); }

std::string error_text(const Json& row) {
    const RowError error = row_error(row);
    if (std::isnan(error.wrong_share)) return "errors not measured";
    const std::string wrong = percent(error.wrong_share) + " of the rays wrong";
    return error.distance_p99 ? fmt::format("p99 {} r, {}", significant(*error.distance_p99, 2), wrong)
                              : wrong;
}

std::string memory_text(const Json& row) {
    const auto bytes = number_at(row, "memory.bytes_per_curve");
    return bytes ? significant(*bytes) + " B/curve" : "memory not known";
}

std::string case_text(const Json& row) {
    return fmt::format("{} ({} ms, {}, {})", label_of(row), significant(row_time(row)), memory_text(row),
                       error_text(row));
}

std::string sentence(std::span<const Json> rows, const std::vector<size_t>& members, double limit) {
    const Json& first = rows[members.front()];
    const bool hit_or_miss = row_error(first).hit_or_miss_only;
    std::string text = fmt::format("{}, {} rays {}, {} traversal: ", text_at(first, "model.name"),
                                   text_at(first, "rays.name"), text_at(first, "rays.resolution"),
                                   text_at(first, "device.class"));
    const std::string wanted =
        hit_or_miss ? "at most 1 % wrong" : fmt::format("p99 <= {} r", significant(limit, 2));
    const bool has_errors = std::any_of(members.begin(), members.end(),
                                        [&](size_t i) { return !std::isnan(row_error(rows[i]).ranking); });
    if (!has_errors) return text + "no errors to choose by (not measured, or no ray hits).";
    const Choices choices = choose(rows, members, limit);
    if (choices.fastest)
        text += fmt::format("fastest with {}: {}", wanted, case_text(rows[*choices.fastest]));
    else
        text += fmt::format("none with {}", wanted);
    if (choices.smallest)
        text += choices.smallest == choices.fastest
                    ? ", also the smallest"
                    : fmt::format("; smallest: {}", case_text(rows[*choices.smallest]));
    if (choices.fastest_of_all && choices.fastest_of_all != choices.fastest)
        text += fmt::format("; fastest of all: {}", case_text(rows[*choices.fastest_of_all]));
    return text + ".";
}

}  // namespace

std::vector<std::string> result_words(std::span<const Json> rows, double limit) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<size_t>> groups;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (!is_choice(rows[i])) continue;
        const std::string group = comparable_group(rows[i]);
        if (!groups.contains(group)) order.push_back(group);
        groups[group].push_back(i);
    }
    std::vector<std::string> sentences;
    for (const std::string& group : order) sentences.push_back(sentence(rows, groups[group], limit));
    return sentences;
}

}  // namespace strandlab
