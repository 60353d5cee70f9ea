#include "measure/stress.h"

#include "base/error.h"
#include "base/parallel.h"
#include "measure/ray_error.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

/// The leaves of every strand, in ascending order.
class StrandLeaves {
  public:
    StrandLeaves(const Geometry& geometry, uint64_t strands, uint32_t curves)
        : first_(strands + 1, 0), leaves_(geometry.leaf_count()) {
        for (const Leaf& leaf : geometry.leaves) ++first_[leaf.curve / curves + 1];
        for (size_t i = 0; i < strands; ++i) first_[i + 1] += first_[i];
        std::vector<size_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < leaves_.size(); ++i) leaves_[next[geometry.leaves[i].curve / curves]++] = i;
    }
    std::span<const uint32_t> of(size_t strand) const {
        return std::span(leaves_).subspan(first_[strand], first_[strand + 1] - first_[strand]);
    }

  private:
    std::vector<size_t> first_;
    std::vector<uint32_t> leaves_;
};

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

/// The nearest hit over some leaves; counts leaf hits and those whose box the ray misses.
template <class Real, class Intersect, class Finish>
StressHit nearest(const Geometry& geometry, std::span<const uint32_t> leaves, std::span<const Box> boxes,
                  const Ray& ray, Intersect intersect, Finish finish, BoxCheck& check) {
    LeafHit<Real> best;
    uint32_t best_leaf = no_curve;
    for (const uint32_t leaf : leaves) {
        LeafHit<Real> hit;
        const Real limit = best_leaf == no_curve ? Real(ray.tmax) : best.t;
        if (!intersect(geometry, leaf, ray, limit, hit)) continue;
        ++check.trials;
        if (!slab_hit(boxes[leaf], ray)) ++check.lost;
        best = hit;
        best_leaf = leaf;
    }
    if (best_leaf == no_curve) return {};
    if (finish != nullptr) finish(geometry, best_leaf, ray, best);
    return {double(best.t), true};
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

/// Adds one decisive pair; returns how wrong it is.
double add_error(const StressAnswer& answer, const StressHit& hit, double length, StressTally& tally) {
    ++(answer.is_hit ? tally.hits : tally.misses);
    if (hit.is_hit && !std::isfinite(hit.t)) {
        ++tally.nan_hits;
        return not_a_number;
    }
    if (hit.is_hit != answer.is_hit) {
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
    if (primitive.cpu.single == nullptr || primitive.cpu.precise == nullptr)
        fail(ExitCode::usage, "primitive {}: has no C++ intersector; name another one", primitive.name);
    const StrandLeaves leaves(geometry, pairs.range.count, pairs.range.family->curves);
    float extent = 0;
    for (const Ray& ray : pairs.rays)
        for (int i = 0; i < 3; ++i)
            if (is_valid(ray)) extent = std::max(extent, std::abs(ray.origin[i]));
    std::vector<Box> boxes = leaf_boxes(geometry);
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(boxes[i], extent); });
    std::vector<StressHit> hits(pairs.rays.size());
    std::atomic<uint64_t> lost{0}, trials{0};
    parallel_for(hits.size(), [&](size_t i) {
        const Ray& ray = pairs.rays[i];
        if (!is_valid(ray)) return;
        BoxCheck check;
        hits[i] = precision == Precision::single
                      ? nearest<float>(geometry, leaves.of(i), boxes, ray, primitive.cpu.single,
                                       primitive.cpu.finish_single, check)
                      : nearest<double>(geometry, leaves.of(i), boxes, ray, primitive.cpu.precise,
                                        primitive.cpu.finish_precise, check);
        if (check.trials == 0) return;
        trials += check.trials;
        if (check.lost > 0) lost += check.lost;
    });
    checks.add({lost, trials});
    return hits;
}

void add_errors(const StressPairs& pairs, std::span<const StressHit> hits, size_t keep, StressTally& tally) {
    assert(hits.size() == pairs.rays.size());
    for (size_t i = 0; i < hits.size(); ++i) {
        const StressAnswer& answer = pairs.answers[i];
        ++tally.pairs;
        tally.margin.add(answer.margin);
        const double length = glm::length(glm::dvec3(pairs.rays[i].direction));
        double error = 0;
        if (answer.decisive)
            error = add_error(answer, hits[i], length, tally);
        else if (hits[i].is_hit && !std::isfinite(hits[i].t))
            ++tally.nan_hits, error = not_a_number;
        keep_worst(tally.worst, {error, pairs.range.first + i, pairs.rays[i]}, keep);
    }
}

void add_difference(const StressPairs& pairs, std::span<const StressHit> device,
                    std::span<const StressHit> plain, StressTally& tally) {
    for (size_t i = 0; i < device.size(); ++i) {
        const StressHit &a = device[i], &b = plain[i];
        ++tally.compared;
        if (b.is_hit) tally.boxes.add({a.is_hit ? 0u : 1u, 1u});
        if (a.is_hit != b.is_hit) {
            ++tally.differing;
        } else if (a.is_hit) {
            const double length = glm::length(glm::dvec3(pairs.rays[i].direction));
            const double allowed =
                std::max(4 * float_ulp(b.t), 1e-4 * pairs.answers[i].radius / std::max(length, 1e-300));
            if (!(std::abs(a.t - b.t) <= allowed)) ++tally.differing;
        }
    }
}

}  // namespace strandlab
