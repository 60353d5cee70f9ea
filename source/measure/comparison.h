// What a trace got wrong against a reference: the one comparison that every command uses.
#pragma once

#include "measure/ray_error.h"
#include "measure/statistics.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace strandlab {

/// How often something went wrong, out of how many rays where it could.
struct Count {
    static constexpr size_t no_ray = ~size_t(0);

    uint64_t count = 0, trials = 0;
    size_t first_ray = no_ray;  // index of the first such ray, to look at

    double share() const {
        return trials == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(trials);
    }
    /// 95 % bounds of the share.
    Interval bounds() const { return binomial_bounds(count, trials); }
};

/// Exact percentiles by nearest rank (each is one of the values); all 0 when there is no value.
struct Percentiles {
    uint64_t count = 0;  // rays that the measure exists for
    double p50 = 0, p95 = 0, p99 = 0, p999 = 0, max = 0;
    size_t worst_ray = Count::no_ray;  // the first ray with the largest value

    /// How many values lie below 1e-9, in each decade from there, and from 1e3 on.
    static constexpr int first_decade = -9, last_decade = 3;
    std::array<uint64_t, last_decade - first_decade + 2> decades{};
};

/// One group of rays. Every ray is counted in exactly one of: agreed misses, matches, nan, false_hit,
/// false_miss, wrong_strand, wrong_place. Only matches have measures; a measure that was not asked for
/// or is undefined for all rays has count 0. In the group of the decisive rays, those whose place is
/// undecided are judged by hit or miss and by strand alone: they match with the right strand, and have no
/// measures.
struct Tally {
    uint64_t rays = 0;
    uint64_t agreed_misses = 0, matches = 0;
    Count nan;           // t or u not finite, per ray
    Count false_hit;     // per reference miss
    Count false_miss;    // per reference hit
    Count wrong_strand;  // per reference hit
    Count wrong_place;   // per reference hit (whose place is decisive, among decisive rays)
    Count bad_normal;    // matches whose normal is not finite or zero, per match with normals

    std::array<Percentiles, measure_count> measures;

    const Percentiles& of(Measure measure) const { return measures[static_cast<size_t>(measure)]; }
    bool has_errors() const {
        return nan.count + false_hit.count + false_miss.count + wrong_strand.count + wrong_place.count > 0;
    }
};

/// Errors of one ray set. The groups `all`, `on_cap`, `inside` and `inside_own` hold every ray once;
/// `decisive` is the part of `all` that verdicts may rest on. No figure mixes two groups.
struct Comparison {
    /// Above this margin the surface is too small for its distance to say which rays are right.
    static constexpr double largest_margin = 0.1;

    bool hit_or_miss_only = false;
    double margin = 0;  // d: radii were scaled by 1 +- d to find the decisive rays
    Tally decisive;     // rays of `all` whose reference answer survives the margin
    Tally all;          // rays that start outside and whose reference hit, if any, is not on a cap
    Tally on_cap;       // the reference hit lies on a strand-end cap (and the ray starts outside)
    Tally inside;       // the ray starts inside the reference surface
    Tally inside_own;   // it does not, but it starts inside the surface that was traced

    uint64_t rays() const { return all.rays + on_cap.rays + inside.rays + inside_own.rays; }
    uint64_t undecided() const { return all.rays - decisive.rays; }
    /// Share of the rays of `all` that are undecided.
    double undecided_share() const {
        return all.rays == 0 ? 0.0 : static_cast<double>(undecided()) / static_cast<double>(all.rays);
    }
    /// False: the set gets no verdict (a margin that is NaN is too large).
    bool is_resolvable() const { return margin <= largest_margin; }
};

/// Compares a trace with its reference. Parallel; the result does not depend on the number of threads.
Comparison compare(const ComparisonInput& input);

}  // namespace strandlab
