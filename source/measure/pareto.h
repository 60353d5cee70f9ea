// Which cases are worth choosing when less cost and less error are both wanted.
#pragma once

#include "measure/comparison.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace strandlab {

/// What a case costs (milliseconds, bytes: any unit that all cases share) and how wrong it is.
struct TradeOff {
    double cost = 0, error = 0;
};

/// The Pareto front: result[i] says whether no other case is at least as good as case i in both and better
/// in one. Equal cases are on the front together. A case whose cost or error is not finite is never on it.
/// Callers see to it that cases are comparable: one scene, one ray set, one class of devices.
std::vector<bool> pareto_front(std::span<const TradeOff> cases);

/// The cheapest case whose error is at most `limit` (the less wrong one where costs are equal, then the
/// first); nothing where there is none. Costs that are not finite do not count.
std::optional<size_t> cheapest_within(std::span<const TradeOff> cases, double limit);

/// Above this share of wrong rays, 99 % of the rays have no distance that they stay within.
inline constexpr double largest_wrong_share = 0.01;

/// Share of the rays that are wrong beyond any distance (NaN, hit instead of miss, miss instead of hit,
/// another strand, another place) among those that meet hair in either answer: much background makes nobody
/// better. 0 where none does.
double wrong_share(const Tally& tally);

/// The one error that a case is ranked by: the 99th percentile of |dt|/r of the right hits, infinite where
/// more than largest_wrong_share of the rays that meet hair are wrong, since then no distance holds for 99 %
/// of them. A set of hit or miss alone has no distances: 0 or infinite. NaN where nothing was compared.
double ranking_error(double wrong_share, std::optional<double> distance_p99, bool hit_or_miss_only);

/// The same of a comparison: of all rays that start outside and whose hit is not on a cap.
double ranking_error(const Comparison& comparison);

}  // namespace strandlab
