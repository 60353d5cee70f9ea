#include "measure/stress.h"

#include "base/parallel.h"
#include "measure/ray_error.h"
#include "measure/stress_leaves.h"
#include "strands/bezier.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strandlab {
namespace {

/// The textbook slab test in float, as a driver may do it: with no margin of its own.
bool slab_hit(const Box& box, const Ray& ray) {
    float enter = ray.tmin, leave = ray.tmax;
    for (int i = 0; i < 3; ++i) {
        const float inverse = 1.0f / ray.direction[i];
        const float a = (box.low[i] - ray.origin[i]) * inverse, b = (box.high[i] - ray.origin[i]) * inverse;
        // fmin and fmax let the other operand through where one is NaN (0 * infinity).
        enter = std::fmax(enter, std::fmin(a, b));
        leave = std::fmin(leave, std::fmax(a, b));
    }
    return enter <= leave;
}

/// Whether the point of a hit lies in a box; in extended precision the product of two floats is exact.
template <class Real>
bool holds(const Box& box, const Ray& ray, Real t) {
    for (int i = 0; i < 3; ++i) {
        using Wide = long double;
        const Wide x = Wide(ray.origin[i]) + Wide(t) * Wide(ray.direction[i]);
        if (!(x >= Wide(box.low[i]) && x <= Wide(box.high[i]))) return false;
    }
    return true;
}

/// The nearest hit over a strand's leaves, finished; counts leaf hits and those that their boxes would lose.
template <class Real>
StressHit checked_hit(const Primitive& primitive, const Geometry& geometry, std::span<const uint32_t> leaves,
                      std::span<const Box> boxes, const Ray& ray, BoxCheck& check) {
    const auto count = [&](uint32_t leaf, const LeafHit<Real>& hit) {
        ++check.trials;
        check.lost += !slab_hit(boxes[leaf], ray);
        check.outside += !holds(boxes[leaf], ray, hit.t);
    };
    NearestHit<Real> best = nearest_hit<Real>(primitive.cpu, geometry, leaves, ray, count);
    if (!best.found()) return {};
    if constexpr (std::is_same_v<Real, float>) {
        if (primitive.cpu.finish_single) primitive.cpu.finish_single(geometry, best.leaf, ray, best.hit);
    } else {
        if (primitive.cpu.finish_precise) primitive.cpu.finish_precise(geometry, best.leaf, ray, best.hit);
    }
    return {double(best.hit.t), double(best.hit.u), geometry.leaves[best.leaf].curve};
}

/// How wrong one answer is; 0: right, or within the right place.
constexpr double missed = 1e6, not_a_number = 1e9;

void keep_worst(std::vector<WorstPair>& worst, const WorstPair& pair, size_t keep) {
    if (keep == 0 || pair.error == 0) return;
    const auto worse = [](const WorstPair& a, const WorstPair& b) {
        return a.error != b.error ? a.error > b.error : a.index < b.index;
    };
    if (worst.size() == keep && !worse(pair, worst.back())) return;
    if (worst.size() == keep) worst.pop_back();
    worst.insert(std::upper_bound(worst.begin(), worst.end(), pair, worse), pair);
}

/// Adds a decisive hit where discs overlap; returns how wrong it is.
double add_folded(const StressAnswer& answer, const StressHit& hit, double length, StressTally& tally) {
    ++tally.folded;
    const double error = hit.is_hit() ? std::abs(hit.t - answer.t) * length / answer.radius : missed;
    const bool wrong = hit.is_hit() ? answer.decisive_place && !(error <= 0.5) : true;
    tally.folded_errors += wrong;
    return wrong ? std::min(error, missed) : 0;
}

/// Adds one decisive pair; returns how wrong it is.
double add_error(const StressAnswer& answer, const StressHit& hit, double length, StressTally& tally) {
    ++(answer.is_hit ? tally.hits : tally.misses);
    if (hit.is_hit() && !std::isfinite(hit.t)) {
        ++tally.nan_hits;
        return not_a_number;
    }
    if (hit.is_hit() != answer.is_hit) {
        ++(answer.is_hit ? tally.false_misses : tally.false_hits);
        return missed;
    }
    if (!answer.is_hit) return 0;
    const double ulp = float_ulp(answer.t);
    tally.floor.add(ulp * length / answer.radius);
    if (!answer.decisive_place) return 0;
    const double error = std::abs(hit.t - answer.t);
    if (error > std::max(0.5 * answer.radius / length, 8 * ulp))
        ++tally.wrong_hits;
    else
        tally.distance.add(error * length / answer.radius);
    return error * length / answer.radius;
}

}  // namespace

std::vector<StressHit> intersect_pairs(const Primitive& primitive, const Geometry& geometry,
                                       const StressPairs& pairs, Precision precision, BoxCheck& checks) {
    require_cpu_version(primitive);
    const StrandLeaves leaves(geometry, pairs.range.count, pairs.range.family->curves);
    const float extent = extent_of(pairs.rays);
    std::vector<Box> boxes = leaf_boxes(geometry);
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(boxes[i], extent); });
    std::vector<StressHit> hits(pairs.rays.size());
    std::vector<BoxCheck> found(pairs.rays.size());
    parallel_for(hits.size(), [&](size_t i) {
        const Ray& ray = pairs.rays[i];
        if (!is_valid(ray)) return;
        hits[i] = precision == Precision::single
                      ? checked_hit<float>(primitive, geometry, leaves.of(i), boxes, ray, found[i])
                      : checked_hit<double>(primitive, geometry, leaves.of(i), boxes, ray, found[i]);
    });
    for (const BoxCheck& check : found) checks.add(check);
    return hits;
}

void count_iterations(const Primitive& primitive, const Geometry& geometry, const StressPairs& pairs,
                      IterationHistogram& iterations) {
    if (primitive.cpu.counted == nullptr) return;
    const StrandLeaves leaves(geometry, pairs.range.count, pairs.range.family->curves);
    std::vector<uint32_t> counts(pairs.rays.size(), 0);
    parallel_for(counts.size(), [&](size_t i) {
        const Ray& ray = pairs.rays[i];
        if (!is_valid(ray)) return;
        float limit = ray.tmax;
        for (const uint32_t leaf : leaves.of(i)) {
            LeafHit<float> hit;
            if (primitive.cpu.counted(geometry, leaf, ray, limit, hit, counts[i])) limit = hit.t;
        }
    });
    for (size_t i = 0; i < counts.size(); ++i)
        if (is_valid(pairs.rays[i])) iterations.add(counts[i]);
}

void add_errors(const StressPairs& pairs, std::span<const StressHit> hits, size_t keep, StressTally& tally) {
    assert(hits.size() == pairs.rays.size());
    for (size_t i = 0; i < hits.size(); ++i) {
        const StressAnswer& answer = pairs.answers[i];
        ++tally.pairs;
        tally.margin.add(answer.margin);
        const double length = glm::length(glm::dvec3(pairs.rays[i].direction));
        double error = 0;
        if (answer.decisive && answer.folded && !(hits[i].is_hit() && !std::isfinite(hits[i].t)))
            error = add_folded(answer, hits[i], length, tally);
        else if (answer.decisive)
            error = add_error(answer, hits[i], length, tally);
        else if (hits[i].is_hit() && !std::isfinite(hits[i].t))
            ++tally.nan_hits, error = not_a_number;
        keep_worst(tally.worst, {error, pairs.range.first + i, pairs.rays[i]}, keep);
    }
}

void add_difference(const Curves& curves, std::span<const Ray> rays, std::span<const StressHit> device,
                    std::span<const StressHit> plain, Agreement& agreement) {
    for (size_t i = 0; i < device.size(); ++i) {
        const StressHit &a = device[i], &b = plain[i];
        ++agreement.pairs;
        if (!a.is_hit() || !b.is_hit()) {
            agreement.only_device += a.is_hit();
            agreement.only_cpu += b.is_hit();
            continue;
        }
        ++agreement.both_hit;
        const double length = glm::length(glm::dvec3(rays[i].direction));
        const double radius = std::abs(point_at(to_double(curves.curves[b.curve]), b.u).w);
        const double difference = std::abs(a.t - b.t), ulp = float_ulp(b.t);
        // Where nothing differs nothing is divided, by a radius or length of 0.
        const auto relative = [&](double unit) { return difference == 0 ? 0 : difference / unit; };
        agreement.ulps.add(relative(ulp));
        agreement.radii.add(relative(radius / length));
        agreement.allowed.add(relative(std::max(4 * ulp, 1e-4 * radius / length)));
    }
}

}  // namespace strandlab
