#include "measure/comparison.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace strandlab {
namespace {

/// decisive_strand: hit or miss and the strand are decisive, the place is not.
enum class Group : uint8_t { decisive, decisive_strand, undecided, on_cap, inside, inside_own };

struct Judged {
    RayError error;
    Group group = Group::decisive;
};

Group group_of(const ComparisonInput& input, size_t ray) {
    const ReferenceHit& reference = input.reference[ray];
    if (reference.starts_inside) return Group::inside;
    if (!input.inside_own.empty() && input.inside_own[ray] != 0) return Group::inside_own;
    if (reference.is_hit() && reference.on_cap) return Group::on_cap;
    if (!input.decisive.empty() && input.decisive[ray] == 0) return Group::undecided;
    const bool has_place = input.decisive_place.empty() || input.decisive_place[ray] != 0;
    return has_place ? Group::decisive : Group::decisive_strand;
}

/// The groups that a tally is made of.
struct Selection {
    Tally* tally;
    Group first, last;

    bool holds(const Judged& ray) const { return ray.group >= first && ray.group <= last; }
    /// Whether the tally judges where a ray hits.
    bool has_place(const Judged& ray) const {
        return last != Group::decisive_strand || ray.group != Group::decisive_strand;
    }
};

void add(Count& count, bool happened, size_t ray) {
    ++count.trials;
    if (!happened) return;
    if (count.count++ == 0) count.first_ray = ray;
}

void count_outcomes(const ComparisonInput& input, std::span<const Judged> judged,
                    const Selection& selection) {
    Tally& tally = *selection.tally;
    for (size_t i = 0; i < judged.size(); ++i) {
        if (!selection.holds(judged[i])) continue;
        RayError error = judged[i].error;
        const bool has_place = selection.has_place(judged[i]);
        if (!has_place && error.outcome == Outcome::wrong_place) error.outcome = Outcome::match;
        ++tally.rays;
        tally.agreed_misses += error.outcome == Outcome::agreed_miss;
        tally.matches += error.outcome == Outcome::match;
        add(tally.nan, error.outcome == Outcome::nan, i);
        if (input.reference[i].is_hit()) {
            add(tally.false_miss, error.outcome == Outcome::false_miss, i);
            add(tally.wrong_strand, error.outcome == Outcome::wrong_strand, i);
            if (has_place) add(tally.wrong_place, error.outcome == Outcome::wrong_place, i);
        } else {
            add(tally.false_hit, error.outcome == Outcome::false_hit, i);
        }
        const bool has_normal = !input.normals.empty() && !input.hit_or_miss_only;
        if (error.outcome == Outcome::match && has_normal) add(tally.bad_normal, error.bad_normal, i);
    }
}

/// The bin of Percentiles::decades for a value; the logarithm of 0 is clamped like every small one.
size_t decade_of(double value) {
    constexpr double low = Percentiles::first_decade - 1, high = Percentiles::last_decade;
    return static_cast<size_t>(std::clamp(std::floor(std::log10(value)), low, high) - low);
}

/// Percentiles of values, whose order changes.
Percentiles percentiles_of(std::vector<float>& values) {
    Percentiles result;
    result.count = values.size();
    for (const float value : values) ++result.decades[decade_of(double(value))];
    if (values.empty()) return result;
    // From the top down, each selection leaves the smaller values before it for the next.
    auto end = values.end();
    const auto select = [&](double q) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(nearest_rank(q, values.size()));
        if (place < end) {
            std::nth_element(values.begin(), place, end);
            end = place;
        }
        return static_cast<double>(*place);
    };
    result.max = select(1.0);
    result.p999 = select(0.999);
    result.p99 = select(0.99);
    result.p95 = select(0.95);
    result.p50 = select(0.5);
    return result;
}

void measure_group(std::span<const Judged> judged, const Selection& selection, size_t measure) {
    std::vector<float> values;
    size_t worst = Count::no_ray;
    float largest = -1;
    for (size_t i = 0; i < judged.size(); ++i) {
        const float value = judged[i].error.measures[measure];
        if (std::isnan(value) || !selection.holds(judged[i]) || !selection.has_place(judged[i])) continue;
        values.push_back(value);
        if (value <= largest) continue;
        largest = value;
        worst = i;
    }
    Percentiles& result = selection.tally->measures[measure];
    result = percentiles_of(values);
    result.worst_ray = worst;
}

}  // namespace

Comparison compare(const ComparisonInput& input) {
    const RayErrors errors(input);
    std::vector<Judged> judged(input.rays.size());
    parallel_for(judged.size(), [&](size_t i) { judged[i] = {errors.of(i), group_of(input, i)}; });

    Comparison result;
    result.hit_or_miss_only = input.hit_or_miss_only;
    result.margin = input.margin;
    const std::array selections{Selection{&result.decisive, Group::decisive, Group::decisive_strand},
                                Selection{&result.all, Group::decisive, Group::undecided},
                                Selection{&result.on_cap, Group::on_cap, Group::on_cap},
                                Selection{&result.inside, Group::inside, Group::inside},
                                Selection{&result.inside_own, Group::inside_own, Group::inside_own}};
    // Task k of a group is its measure k, the last one its counts: each writes its own part of the tally.
    constexpr size_t tasks = measure_count + 1;
    parallel_for(selections.size() * tasks, [&](size_t task) {
        const Selection& selection = selections[task / tasks];
        if (task % tasks == measure_count)
            count_outcomes(input, judged, selection);
        else
            measure_group(judged, selection, task % tasks);
    });
    return result;
}

}  // namespace strandlab
