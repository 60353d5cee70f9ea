#include "primitives/leaf_budget.h"

#include "base/parallel.h"
#include "strands/bezier.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <mutex>
#include <numeric>

namespace strandlab {
namespace {

/// Counts that a curve may have; the powers of two are where `least` lies.
constexpr std::array<uint32_t, 19> counts{1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 64};

/// Equal counts are taken at up to this much more surface: an entry of the table is read at every leaf.
constexpr double table_cost = 1.1;

/// Gains by their size, in steps of under 1 %: the leading bits of a positive float are in its order.
constexpr int dropped_bits = 16;
constexpr size_t bin_count = size_t(1) << (31 - dropped_bits);
uint32_t bin_of(float gain) { return std::bit_cast<uint32_t>(gain) >> dropped_bits; }

/// A step from one count to a larger one.
struct Step {
    uint32_t pieces = 0;  // after it
    uint32_t extra = 0;   // leaves
    uint32_t bin = 0;     // of the surface that each of them takes away
};

/// The steps that pay, from `least` on, each less than the one before (the lower hull of surface over count).
template <class Visit>
void for_each_step(const Curve& curve, uint32_t least, Visit&& visit) {
    std::array<float, counts.size()> surface{};
    const auto* const start = std::find(counts.begin(), counts.end(), least);
    auto at = static_cast<size_t>(start - counts.begin());
    for (size_t i = at; i < counts.size(); ++i) surface[i] = float(box_surface(curve, counts[i]));
    while (at + 1 < counts.size()) {
        size_t best = at;
        float best_gain = 0;
        for (size_t i = at + 1; i < counts.size(); ++i) {
            const float gain = (surface[at] - surface[i]) / float(counts[i] - counts[at]);
            if (!(gain > best_gain)) continue;
            best = i;
            best_gain = gain;
        }
        if (best == at || !std::isfinite(best_gain)) return;
        visit(Step{counts[best], counts[best] - counts[at], bin_of(best_gain)});
        at = best;
    }
}

/// Leaves that all steps of each bin together add.
std::vector<uint64_t> extra_leaves(const Curves& curves, const std::vector<uint32_t>& least) {
    std::vector<uint64_t> all(bin_count, 0);
    std::mutex mutex;
    constexpr size_t chunk = 4096;
    parallel_for((curves.curves.size() + chunk - 1) / chunk, [&](size_t c) {
        std::vector<Step> steps;
        const size_t end = std::min(curves.curves.size(), (c + 1) * chunk);
        for (size_t i = c * chunk; i < end; ++i)
            for_each_step(curves.curves[i], least[i], [&](const Step& step) { steps.push_back(step); });
        const std::lock_guard lock(mutex);
        for (const Step& step : steps) all[step.bin] += step.extra;
    });
    return all;
}

double surface_of(const Curves& curves, const std::vector<uint32_t>& pieces) {
    std::vector<double> surface(pieces.size());
    parallel_for(pieces.size(), [&](size_t i) { surface[i] = box_surface(curves.curves[i], pieces[i]); });
    return std::accumulate(surface.begin(), surface.end(), 0.0);
}

/// Takes the steps of all bins above the first that does not fit whole, and of that one what fits, from the
/// first curve on.
std::vector<uint32_t> adapted(const Curves& curves, const std::vector<uint32_t>& least, uint64_t spare) {
    const std::vector<uint64_t> extra = extra_leaves(curves, least);
    size_t last = bin_count;  // bins from here on are taken whole
    while (last > 0 && extra[last - 1] <= spare) spare -= extra[--last];
    std::vector<uint32_t> pieces = least;
    std::vector<Step> next(pieces.size());  // of the bin that does not fit whole
    parallel_for(pieces.size(), [&](size_t i) {
        for_each_step(curves.curves[i], least[i], [&](const Step& step) {
            if (step.bin >= last)
                pieces[i] = step.pieces;
            else if (step.bin + 1 == last && next[i].pieces == 0)
                next[i] = step;
        });
    });
    for (size_t i = 0; i < pieces.size(); ++i) {
        if (next[i].pieces == 0 || next[i].extra > spare) continue;
        pieces[i] = next[i].pieces;
        spare -= next[i].extra;
    }
    return pieces;
}

}  // namespace

double box_surface(const Curve& curve, uint32_t n) {
    const CurveD c = to_double(curve);
    const double h = 1.0 / n;
    const glm::dvec4 bend =
        glm::max(glm::abs(second_derivative_at(c, 0)), glm::abs(second_derivative_at(c, 1)));
    const glm::dvec3 bulge = glm::dvec3(bend) * (h * h / 8);
    double sum = 0;
    glm::dvec4 start = c[0];
    for (uint32_t i = 1; i <= n; ++i) {
        const glm::dvec4 end = point_at(c, i * h);
        const glm::dvec3 size = glm::abs(glm::dvec3(end - start)) + bulge + start.w + end.w;
        sum += size.x * size.y + size.y * size.z + size.z * size.x;
        start = end;
    }
    return sum;
}

std::vector<uint32_t> pieces_within(const Curves& curves, const std::vector<uint32_t>& least,
                                    const LeafBudget& budget) {
    if (curves.curves.empty()) return least;
    const auto count = double(least.size());
    const auto most = static_cast<uint64_t>(budget.leaves * count);
    const uint64_t needed = std::accumulate(least.begin(), least.end(), uint64_t(0));
    std::vector<uint32_t> own = needed < most ? adapted(curves, least, most - needed) : least;
    const auto equal = static_cast<uint32_t>(std::clamp(budget.uniform_leaves, 1.0, double(counts.back())));
    if (equal < *std::max_element(least.begin(), least.end())) return own;
    std::vector<uint32_t> alike(least.size(), equal);
    if (budget.uniform_leaves < 1) return own;
    return needed > most || surface_of(curves, alike) <= table_cost * surface_of(curves, own) ? alike : own;
}

}  // namespace strandlab
