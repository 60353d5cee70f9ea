#include "measure/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace strandlab {

std::vector<bool> pareto_front(std::span<const TradeOff> cases) {
    std::vector<size_t> order;
    for (size_t i = 0; i < cases.size(); ++i)
        if (std::isfinite(cases[i].cost) && std::isfinite(cases[i].error)) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return cases[a].cost != cases[b].cost ? cases[a].cost < cases[b].cost
                                              : cases[a].error < cases[b].error;
    });
    std::vector<bool> front(cases.size(), false);
    // From the cheapest on: a case is worth its cost when it is less wrong than all cheaper ones.
    const TradeOff* last = nullptr;
    for (const size_t i : order) {
        const bool equals_last = last && cases[i].cost == last->cost && cases[i].error == last->error;
        if (last && !(cases[i].error < last->error) && !equals_last) continue;
        front[i] = true;
        last = &cases[i];
    }
    return front;
}

std::optional<size_t> cheapest_within(std::span<const TradeOff> cases, double limit) {
    std::optional<size_t> best;
    for (size_t i = 0; i < cases.size(); ++i) {
        const TradeOff& one = cases[i];
        if (!std::isfinite(one.cost) || !(one.error <= limit)) continue;
        const bool better = !best || one.cost < cases[*best].cost ||
                            (one.cost == cases[*best].cost && one.error < cases[*best].error);
        if (better) best = i;
    }
    return best;
}

double wrong_share(const Tally& tally) {
    const uint64_t wrong = tally.nan.count + tally.false_hit.count + tally.false_miss.count +
                           tally.wrong_strand.count + tally.wrong_place.count;
    const uint64_t met = tally.rays - tally.agreed_misses;
    return met == 0 ? 0.0 : static_cast<double>(wrong) / static_cast<double>(met);
}

double ranking_error(double wrong_share, std::optional<double> distance_p99, bool hit_or_miss_only) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!(wrong_share >= 0)) return none;
    if (wrong_share > largest_wrong_share) return std::numeric_limits<double>::infinity();
    return hit_or_miss_only ? 0.0 : distance_p99.value_or(none);
}

double ranking_error(const Comparison& comparison) {
    const Tally& tally = comparison.all;
    if (tally.rays == 0) return std::numeric_limits<double>::quiet_NaN();
    const Percentiles& distance = tally.of(Measure::distance);
    return ranking_error(wrong_share(tally), distance.count ? std::optional(distance.p99) : std::nullopt,
                         comparison.hit_or_miss_only);
}

}  // namespace strandlab
