#include "report/baseline.h"

#include "measure/time_ratio.h"
#include "report/result_json.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string joined(const Json& row, std::initializer_list<const char*> paths) {
    Json texts = Json::array();
    for (const char* path : paths) {
        const Json* value = field_at(row, path);
        texts.push_back(value ? *value : Json());
    }
    return texts.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string key_of(const Json& row) { return text_at(row, "key"); }

std::string label_of_case(const Json& row) {
    return joined(row, {"device.name", "model.name", "rays.name", "rays.resolution", "seed",
                        "primitive.label", "primitive.caps"});
}

std::string primitive_of_case(const Json& row) {
    return joined(row,
                  {"device.name", "model.name", "rays.name", "rays.resolution", "seed", "primitive.name"});
}

struct Pair {
    const Json* now;
    const Json* before;
};

/// Pairs rows of equal names, of those that have no partner yet, where the name is unique on both sides.
void pair_by(const std::function<std::string(const Json&)>& name, std::vector<const Json*>& now,
             std::vector<const Json*>& before, std::vector<Pair>& pairs) {
    std::map<std::string, std::pair<std::vector<const Json*>, std::vector<const Json*>>> groups;
    for (const Json* row : now) groups[name(*row)].first.push_back(row);
    for (const Json* row : before) groups[name(*row)].second.push_back(row);
    std::vector<const Json*> paired;
    // In the order of the rows.
    for (const Json* row : now) {
        const auto& [mine, theirs] = groups[name(*row)];
        if (mine.size() != 1 || theirs.size() != 1) continue;
        pairs.push_back({row, theirs.front()});
        paired.insert(paired.end(), {row, theirs.front()});
    }
    for (auto* rows : {&now, &before})
        std::erase_if(*rows, [&](const Json* row) {
            return std::find(paired.begin(), paired.end(), row) != paired.end();
        });
}

std::vector<Pair> pair_rows(std::span<const Json> rows, std::span<const Json> baseline,
                            BaselineComparison& result) {
    std::vector<const Json*> now, before;
    for (const Json& row : rows) now.push_back(&row);
    for (const Json& row : baseline) before.push_back(&row);
    std::vector<Pair> pairs;
    pair_by(key_of, now, before, pairs);
    pair_by(label_of_case, now, before, pairs);
    pair_by(primitive_of_case, now, before, pairs);
    if (!now.empty())
        result.notes.push_back(fmt::format("{} rows have no partner in the baseline", now.size()));
    if (!before.empty())
        result.notes.push_back(fmt::format("{} rows of the baseline were not measured", before.size()));
    return pairs;
}

std::string case_name(const Pair& pair) {
    const Json& row = *pair.now;
    const std::string label = text_at(row, "primitive.label"), old = text_at(*pair.before, "primitive.label");
    return fmt::format("{}, {} rays {}, {}{}", text_at(row, "model.name"), text_at(row, "rays.name"),
                       text_at(row, "rays.resolution"), label, label == old ? "" : " (was " + old + ")");
}

/// What must be the same for errors to be comparable.
bool same_input(const Pair& pair, BaselineComparison& result) {
    bool same = true;
    constexpr std::pair<const char*, const char*> inputs[] = {
        {"model.hash", "the curves"}, {"rays.hash", "the rays"}, {"settings.error_rays", "--error-rays"}};
    for (const auto& [path, what] : inputs) {
        const std::string before = joined(*pair.before, {path}), now = joined(*pair.now, {path});
        if (before == now) continue;
        result.worse.push_back(fmt::format("{}: {} changed: {} was {}", case_name(pair), what,
                                           now.substr(1, now.size() - 2),
                                           before.substr(1, before.size() - 2)));
        same = false;
    }
    return same;
}

/// Figures that went up or down, by name.
struct Changes {
    std::vector<std::string> up, down;
};

/// Every number below an object whose size means error.
void compare_figures(const Json& before, const Json& now, const std::string& path, Changes& changes) {
    constexpr std::string_view figures[] = {"p50", "p95", "p99", "p999", "max"};
    for (const auto& [name, value] : now.items()) {
        const auto old = before.find(name);
        const std::string at = path.empty() ? name : path + "." + name;
        const bool is_count = name == "count" && now.contains("trials");
        const bool is_percentile =
            std::find(std::begin(figures), std::end(figures), name) != std::end(figures);
        const Json none = Json::object();
        if (value.is_object()) {
            compare_figures(old != before.end() && old->is_object() ? *old : none, value, at, changes);
        } else if (is_count || is_percentile) {
            const double was = old == before.end() ? 0 : number_of(*old).value_or(0);
            const double is = number_of(value).value_or(0);
            if (is == was) continue;
            (is > was || std::isnan(is) ? changes.up : changes.down)
                .push_back(fmt::format("{} {} was {}", at, is, was));
        }
    }
}

/// The first few, and how many more.
std::string some_of(const std::vector<std::string>& texts) {
    constexpr size_t shown = 3;
    std::string text;
    for (size_t i = 0; i < std::min(shown, texts.size()); ++i) text += (i == 0 ? "" : ", ") + texts[i];
    return texts.size() > shown ? fmt::format("{} and {} more figures", text, texts.size() - shown) : text;
}

void compare_errors(const Pair& pair, BaselineComparison& result) {
    for (const char* error : {"intersector_error", "model_error"}) {
        const Json* now = field_at(*pair.now, error);
        const Json* before = field_at(*pair.before, error);
        if (now == nullptr || before == nullptr) {
            if (now != before)
                result.notes.push_back(
                    fmt::format("{}: {} is in one of the files only", case_name(pair), error));
            continue;
        }
        if (*now == *before) continue;
        Changes changes;
        compare_figures(*before, *now, "", changes);
        const auto line = [&](const std::vector<std::string>& list) {
            return fmt::format("{}: {}: {}", case_name(pair), error, some_of(list));
        };
        if (!changes.up.empty()) result.worse.push_back(line(changes.up));
        if (changes.up.empty() && !changes.down.empty()) result.better.push_back(line(changes.down));
    }
}

std::vector<double> numbers_at(const Json& row, const char* path) {
    std::vector<double> numbers;
    const Json* array = field_at(row, path);
    if (array != nullptr && array->is_array())
        for (const Json& value : *array)
            if (const auto number = number_of(value)) numbers.push_back(*number);
    return numbers;
}

/// The test of a pair's times; none where they say nothing.
std::optional<TimeRatioTest> time_test(const Pair& pair, BaselineComparison& result) {
    const std::string control = text_at(*pair.now, "time.ratio.baseline");
    const bool has_control = !control.empty() && control == text_at(*pair.before, "time.ratio.baseline");
    const bool is_control = has_control && text_at(*pair.now, "primitive.label") == control &&
                            text_at(*pair.before, "primitive.label") == control;
    if (is_control) return std::nullopt;
    if (text_at(*pair.now, "device.name") != text_at(*pair.before, "device.name")) return std::nullopt;
    const char* path = has_control ? "time.ratio.samples" : "time.samples_ms";
    TimeRatioTest test(numbers_at(*pair.now, path), numbers_at(*pair.before, path));
    if (!test.is_known()) return std::nullopt;
    if (!has_control)
        result.notes.push_back(case_name(pair) +
                               ": no baseline primitive in both files; times are compared as they are");
    return test;
}

void compare_times(const std::vector<Pair>& pairs, double factor, BaselineComparison& result) {
    std::vector<std::pair<const Pair*, TimeRatioTest>> tests;
    for (const Pair& pair : pairs)
        if (auto test = time_test(pair, result)) tests.emplace_back(&pair, *test);
    result.times = tests.size();
    std::vector<double> slower, faster;
    for (const auto& [pair, test] : tests) {
        slower.push_back(test.p_above(factor));
        faster.push_back(test.p_below(1 / factor));
    }
    const std::vector<double> slower_levels = holm_levels(slower), faster_levels = holm_levels(faster);
    for (size_t i = 0; i < tests.size(); ++i) {
        const auto& [pair, test] = tests[i];
        if (slower_levels[i] > 0)
            result.worse.push_back(fmt::format("{}: slower, {} times as long (at least {})", case_name(*pair),
                                               significant(test.ratio()),
                                               significant(test.lower_bound(slower_levels[i]))));
        if (faster_levels[i] > 0)
            result.better.push_back(fmt::format("{}: faster, {} times as long (at most {})", case_name(*pair),
                                                significant(test.ratio()),
                                                significant(test.upper_bound(faster_levels[i]))));
    }
}

}  // namespace

BaselineComparison compare_with_baseline(std::span<const Json> rows, std::span<const Json> baseline,
                                         double factor) {
    BaselineComparison result;
    const std::vector<Pair> pairs = pair_rows(rows, baseline, result);
    result.rows = pairs.size();
    for (const Pair& pair : pairs)
        if (same_input(pair, result)) compare_errors(pair, result);
    compare_times(pairs, factor, result);
    return result;
}

std::string to_text(const BaselineComparison& comparison) {
    std::string text =
        fmt::format("baseline: {} rows compared, times of {}: ", comparison.rows, comparison.times);
    text += comparison.worse.empty() && comparison.better.empty()
                ? "no difference\n"
                : fmt::format("{} worse, {} better\n", comparison.worse.size(), comparison.better.size());
    const std::pair<const char*, const std::vector<std::string>*> parts[] = {
        {"worse", &comparison.worse}, {"better", &comparison.better}, {"note", &comparison.notes}};
    for (const auto& [name, lines] : parts)
        for (const std::string& line : *lines) text += fmt::format("  {}: {}\n", name, line);
    return text;
}

}  // namespace strandlab
