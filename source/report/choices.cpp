#include "report/choices.h"

#include "report/fronts.h"
#include "report/row_fields.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// The cheapest member by one cost within a limit of its error.
std::optional<size_t> cheapest(std::span<const Json> rows, std::span<const size_t> members,
                               double (*cost)(const Json&), double limit) {
    std::vector<TradeOff> cases;
    for (const size_t i : members) {
        const double error = row_error(rows[i]).ranking;
        // Without a limit, rows whose errors were not measured count too.
        cases.push_back({cost(rows[i]), std::isinf(limit) && std::isnan(error) ? limit : error});
    }
    const auto found = cheapest_within(cases, limit);
    return found ? std::optional(members[*found]) : std::nullopt;
}

std::optional<size_t> most_accurate(std::span<const Json> rows, std::span<const size_t> members) {
    std::optional<size_t> best;
    const auto rank = [&](size_t i) {
        const RowError error = row_error(rows[i]);
        return std::tuple(error.ranking, error.wrong_share, row_time(rows[i]));
    };
    for (const size_t i : members)
        if (std::isfinite(row_error(rows[i]).ranking) && (!best || rank(i) < rank(*best))) best = i;
    return best;
}

bool intervals_meet(const Json& a, const Json& b) {
    const auto low = [](const Json& row) { return number_or_nan(row, "time.trace_ms.low"); };
    const auto high = [](const Json& row) { return number_or_nan(row, "time.trace_ms.high"); };
    return low(a) <= high(b) && low(b) <= high(a);
}

}  // namespace

Choices choose(std::span<const Json> rows, std::span<const size_t> members, double limit) {
    constexpr double any = std::numeric_limits<double>::infinity();
    std::vector<size_t> choosable;
    std::copy_if(members.begin(), members.end(), std::back_inserter(choosable),
                 [&](size_t i) { return is_choice(rows[i]); });
    Choices choices;
    choices.fastest = cheapest(rows, choosable, row_time, limit);
    choices.smallest = cheapest(rows, choosable, row_memory, limit);
    choices.most_accurate = most_accurate(rows, choosable);
    choices.fastest_of_all = cheapest(rows, choosable, row_time, any);
    for (const size_t i : choosable)
        if (choices.fastest && i != *choices.fastest && row_error(rows[i]).ranking <= limit &&
            intervals_meet(rows[i], rows[*choices.fastest]))
            choices.as_fast.push_back(i);
    return choices;
}

}  // namespace strandlab
