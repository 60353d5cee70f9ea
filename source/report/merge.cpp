#include "report/merge.h"

#include "report/row_fields.h"
#include "report/sweep.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// Numbers of sweeps by their ids, in the order in which they are first seen.
class SweepNumbers {
  public:
    size_t of(const Json& row) {
        return numbers_.emplace(text_at(row, "sweep.id"), numbers_.size()).first->second;
    }

  private:
    std::map<std::string, size_t> numbers_;
};

std::vector<std::string> texts_at(const Json& row, std::string_view path) {
    std::vector<std::string> all;
    const Json* array = field_at(row, path);
    if (array != nullptr && array->is_array())
        for (const Json& text : *array)
            if (text.is_string()) all.push_back(text.get<std::string>());
    return all;
}

/// The cases of one sweep, and which of them have rows.
struct Found {
    SweepAxes axes;
    std::set<size_t> numbers;
};

}  // namespace

std::vector<Json> merged_rows(std::vector<Json> rows) {
    std::map<std::string, size_t> last;
    for (size_t i = 0; i < rows.size(); ++i) last[text_at(rows[i], "key")] = i;
    struct Place {
        size_t sweep, number, row;
    };
    std::vector<Place> places;
    SweepNumbers sweeps;
    for (size_t i = 0; i < rows.size(); ++i) {
        const std::string key = text_at(rows[i], "key");
        const size_t sweep = sweeps.of(rows[i]);
        if (!key.empty() && last[key] != i) continue;
        places.push_back({sweep, static_cast<size_t>(number_at(rows[i], "sweep.case").value_or(0)), i});
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::pair(a.sweep, a.number) < std::pair(b.sweep, b.number);
    });
    std::vector<Json> merged;
    for (const Place& place : places) merged.push_back(std::move(rows[place.row]));
    return merged;
}

std::vector<std::string> missing_cases(std::span<const Json> rows) {
    SweepNumbers order;
    std::map<size_t, Found> sweeps;
    for (const Json& row : rows) {
        Found& found = sweeps[order.of(row)];
        found.axes = {texts_at(row, "sweep.models"), texts_at(row, "sweep.resolutions"),
                      texts_at(row, "sweep.rays"), texts_at(row, "sweep.primitives")};
        if (const auto number = number_at(row, "sweep.case"))
            found.numbers.insert(static_cast<size_t>(*number));
    }
    std::vector<std::string> missing;
    for (const auto& [sweep, found] : sweeps)
        for (size_t number = 0; number < found.axes.cases(); ++number)
            if (!found.numbers.contains(number)) missing.push_back(found.axes.name(number));
    return missing;
}

}  // namespace strandlab
