#include "report/fronts.h"

#include "primitives/primitive.h"
#include "report/row_fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// Marks the front of some rows.
void mark(std::span<const Json> rows, const std::vector<size_t>& members, double (*cost)(const Json&),
          double RowError::*error, bool FrontMarks::*flag, std::vector<FrontMarks>& marks) {
    std::vector<TradeOff> cases;
    for (const size_t i : members) cases.push_back({cost(rows[i]), row_error(rows[i]).*error});
    const std::vector<bool> front = pareto_front(cases);
    for (size_t i = 0; i < members.size(); ++i) marks[members[i]].*flag = front[i];
}

}  // namespace

RowError row_error(const Json& row) {
    RowError error;
    error.hit_or_miss_only = is_true_at(row, "model_error.hit_or_miss_only");
    error.distance_p99 = number_at(row, "model_error.all.distance.p99");
    error.wrong_share = std::numeric_limits<double>::quiet_NaN();
    const double rays = number_or_nan(row, "model_error.all.rays");
    if (rays > 0) {
        double wrong = 0;
        for (const char* outcome : {"nan", "false_hit", "false_miss", "wrong_strand", "wrong_place"})
            wrong += number_or_nan(row, std::string("model_error.all.") + outcome + ".count");
        const double met = rays - number_at(row, "model_error.all.agreed_misses").value_or(0);
        error.wrong_share = met > 0 ? wrong / met : 0;
    }
    error.ranking = ranking_error(error.wrong_share, error.distance_p99, error.hit_or_miss_only);
    return error;
}

double row_time(const Json& row) { return number_or_nan(row, "time.trace_ms.median"); }

double row_memory(const Json& row) { return number_or_nan(row, "memory.resident_bytes"); }

bool is_second_opinion(const Json& row) { return text_at(row, "device.driver").starts_with("Embree"); }

bool is_choice(const Json& row) {
    const std::string name = text_at(row, "primitive.name");
    const auto found = std::find_if(primitives().begin(), primitives().end(),
                                    [&](const Primitive& one) { return one.name == name; });
    return !is_second_opinion(row) && (found == primitives().end() || !found->diagnostic);
}

std::string comparable_group(const Json& row) {
    // An array, so that no name can pretend to be another field.
    Json group = Json::array();
    for (const char* path :
         {"device.class", "device.name", "model.name", "model.hash", "rays.name", "rays.hash"})
        group.push_back(text_at(row, path));
    group.push_back(number_at(row, "model.instances").value_or(1));
    return group.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<FrontMarks> pareto_fronts(std::span<const Json> rows) {
    std::map<std::string, std::vector<size_t>> groups;
    for (size_t i = 0; i < rows.size(); ++i)
        if (is_choice(rows[i])) groups[comparable_group(rows[i])].push_back(i);
    std::vector<FrontMarks> marks(rows.size());
    for (const auto& [group, members] : groups) {
        mark(rows, members, row_time, &RowError::ranking, &FrontMarks::time_error, marks);
        mark(rows, members, row_memory, &RowError::ranking, &FrontMarks::memory_error, marks);
        mark(rows, members, row_time, &RowError::wrong_share, &FrontMarks::time_wrong, marks);
        mark(rows, members, row_memory, &RowError::wrong_share, &FrontMarks::memory_wrong, marks);
    }
    return marks;
}

}  // namespace strandlab
