#include "report/words.h"

#include "primitives/primitive.h"
#include "report/fronts.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

bool is_choice(const Json& row) {
    const std::string name = text_at(row, "primitive.name");
    const auto found = std::find_if(primitives().begin(), primitives().end(),
                                    [&](const Primitive& one) { return one.name == name; });
    return !is_second_opinion(row) && (found == primitives().end() || !found->diagnostic);
}

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

/// The cheapest row by one cost; nullptr where none is within the limit.
const Json* cheapest(std::span<const Json* const> rows, double (*cost)(const Json&), double limit) {
    std::vector<TradeOff> cases;
    for (const Json* row : rows) {
        const double error = row_error(*row).ranking;
        cases.push_back({cost(*row), std::isnan(error) ? std::numeric_limits<double>::infinity() : error});
    }
    const auto found = cheapest_within(cases, limit);
    return found ? rows[*found] : nullptr;
}

std::string sentence(std::span<const Json* const> rows, double limit) {
    const Json& first = *rows.front();
    const bool hit_or_miss = row_error(first).hit_or_miss_only;
    std::string text = fmt::format("{}, {} rays {}, {} traversal: ", text_at(first, "model.name"),
                                   text_at(first, "rays.name"), text_at(first, "rays.resolution"),
                                   text_at(first, "device.class"));
    const std::string wanted =
        hit_or_miss ? "at most 1 % wrong" : fmt::format("p99 <= {} r", significant(limit, 2));
    const bool has_errors = std::any_of(rows.begin(), rows.end(),
                                        [](const Json* row) { return !std::isnan(row_error(*row).ranking); });
    if (!has_errors) return text + "no errors to choose by (not measured, or no ray hits).";
    const Json* fast = cheapest(rows, row_time, limit);
    const Json* small = cheapest(rows, row_memory, limit);
    if (fast != nullptr)
        text += fmt::format("fastest with {}: {}", wanted, case_text(*fast));
    else
        text += fmt::format("none with {}", wanted);
    if (small != nullptr)
        text += small == fast ? ", also the smallest" : fmt::format("; smallest: {}", case_text(*small));
    const Json* fastest = cheapest(rows, row_time, std::numeric_limits<double>::infinity());
    if (fastest != nullptr && fastest != fast)
        text += fmt::format("; fastest of all: {}", case_text(*fastest));
    return text + ".";
}

}  // namespace

std::vector<std::string> result_words(std::span<const Json> rows, double limit) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const Json*>> groups;
    for (const Json& row : rows) {
        if (!is_choice(row)) continue;
        const std::string group = comparable_group(row);
        if (!groups.contains(group)) order.push_back(group);
        groups[group].push_back(&row);
    }
    std::vector<std::string> sentences;
    for (const std::string& group : order) sentences.push_back(sentence(groups[group], limit));
    return sentences;
}

}  // namespace strandlab
