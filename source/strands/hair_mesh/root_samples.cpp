#include "strands/hair_mesh/root_samples.h"

#include "base/random.h"
#include "strands/hair_mesh/strand_kernel.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace strandlab {
namespace {

constexpr size_t set_size = 4096, candidates_per_sample = 5;

/// Coordinates wrap: the representative in [-1/2, 1/2).
double wrapped(double x) { return x - std::floor(x + 0.5); }

/// A grid over the torus whose cells are as wide as the search radius.
class Grid {
  public:
    Grid(const std::vector<glm::dvec2>& points, double radius)
        : points_(points), cells_(std::max<size_t>(1, static_cast<size_t>(1 / radius))) {
        first_.assign(cells_ * cells_ + 1, 0);
        for (const glm::dvec2& p : points) ++first_[cell(p) + 1];
        for (size_t c = 0; c < cells_ * cells_; ++c) first_[c + 1] += first_[c];
        items_.resize(points.size());
        std::vector<size_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < points.size(); ++i) items_[next[cell(points[i])]++] = i;
    }

    /// Calls visit(j, squared distance) for every point within radius of p.
    template <class Visit>
    void near(const glm::dvec2& p, double radius, Visit&& visit) const {
        const size_t x = coordinate(p.x), y = coordinate(p.y), reach = std::min<size_t>(3, cells_);
        for (size_t j = 0; j < reach; ++j)
            for (size_t i = 0; i < reach; ++i) {
                const size_t c = (y + cells_ + j - 1) % cells_ * cells_ + (x + cells_ + i - 1) % cells_;
                for (size_t k = first_[c]; k < first_[c + 1]; ++k) {
                    const double dx = wrapped(points_[items_[k]].x - p.x),
                                 dy = wrapped(points_[items_[k]].y - p.y);
                    const double squared = dx * dx + dy * dy;
                    if (squared < radius * radius) visit(items_[k], squared);
                }
            }
    }

  private:
    size_t coordinate(double x) const {
        return std::min(cells_ - 1, static_cast<size_t>(x * double(cells_)));
    }
    size_t cell(const glm::dvec2& p) const { return coordinate(p.y) * cells_ + coordinate(p.x); }

    const std::vector<glm::dvec2>& points_;
    size_t cells_;
    std::vector<size_t> first_;
    std::vector<uint32_t> items_;
};

/// Eliminates samples one by one, the most crowded first. Ties go to the lower index.
class Elimination {
  public:
    Elimination(bool on_triangle, double d_min) : on_triangle_(on_triangle), d_min_(d_min) {}

    /// Leaves `keep` of the points; removed holds the others in the order of their removal.
    void run(std::vector<glm::dvec2>& points, size_t keep, double d_max,
             std::vector<glm::dvec2>& removed) const {
        const Grid grid(points, d_max);
        std::vector<double> weights(points.size(), 0.0);
        for (uint32_t i = 0; i < points.size(); ++i)
            neighbours(grid, points[i], d_max, [&](uint32_t j, double w) {
                if (j != i) weights[i] += w;
            });
        using Entry = std::pair<double, uint32_t>;  // entries whose weight is out of date are passed over
        const auto later = [](const Entry& a, const Entry& b) {
            return a.first < b.first || (a.first == b.first && a.second > b.second);
        };
        std::priority_queue<Entry, std::vector<Entry>, decltype(later)> heap(later);
        for (uint32_t i = 0; i < points.size(); ++i) heap.emplace(weights[i], i);
        std::vector<char> alive(points.size(), 1);
        for (size_t left = points.size(); left > keep;) {
            const auto [weight, i] = heap.top();
            heap.pop();
            if (!alive[i] || weight != weights[i]) continue;
            alive[i] = 0;
            --left;
            removed.push_back(points[i]);
            neighbours(grid, points[i], d_max, [&](uint32_t j, double w) {
                if (!alive[j]) return;
                weights[j] -= w;
                heap.emplace(weights[j], j);
            });
        }
        size_t kept = 0;
        for (size_t i = 0; i < points.size(); ++i)
            if (alive[i]) points[kept++] = points[i];
        points.resize(kept);
    }

  private:
    /// Weight (1 - d / d_max)^8 of every neighbour, through the mirrored triangle too.
    template <class Visit>
    void neighbours(const Grid& grid, const glm::dvec2& p, double d_max, Visit&& visit) const {
        const auto weigh = [&](uint32_t j, double squared) {
            const double d = std::max(std::sqrt(squared), d_min_), w = 1 - d / d_max;
            const double w2 = w * w, w4 = w2 * w2;
            visit(j, w4 * w4);
        };
        grid.near(p, d_max, weigh);
        if (on_triangle_) grid.near(1.0 - p, d_max, weigh);
    }

    bool on_triangle_;
    double d_min_;
};

}  // namespace

std::vector<glm::vec2> eliminate_samples(size_t count, bool on_triangle, uint64_t seed) {
    Random random(seed, on_triangle ? 2 : 1);
    const size_t candidates = candidates_per_sample * count;
    std::vector<glm::dvec2> points(candidates);
    for (glm::dvec2& p : points) {
        p.x = random.uniform();
        p.y = random.uniform();
        if (on_triangle && p.x + p.y > 1) p = 1.0 - p;
    }
    const double area = on_triangle ? 0.5 : 1, ratio = double(count) / double(candidates);
    double d_max = 2 * std::sqrt(area / (2 * std::sqrt(3.0) * double(count)));
    const double d_min = d_max * 0.65 * (1 - ratio * std::sqrt(ratio));
    const Elimination elimination(on_triangle, d_min);
    std::vector<glm::dvec2> removed, order;
    elimination.run(points, count, d_max, removed);
    // Half of the rest again and again: what goes first comes last.
    while (points.size() > 1) {
        removed.clear();
        d_max *= std::sqrt(2.0);
        elimination.run(points, points.size() / 2, std::min(d_max, 0.5), removed);
        order.insert(order.end(), removed.begin(), removed.end());
    }
    order.insert(order.end(), points.begin(), points.end());
    return {order.rbegin(), order.rend()};
}

const std::vector<glm::vec2>& square_samples() {
    static const std::vector<glm::vec2> samples = eliminate_samples(set_size, false, 1);
    return samples;
}

const std::vector<glm::vec2>& triangle_samples() {
    static const std::vector<glm::vec2> samples = eliminate_samples(set_size, true, 1);
    return samples;
}

glm::vec2 sample_shift(bool is_triangle, uint32_t round) {
    if (round == 0) return glm::vec2(0);
    Random shift(2, is_triangle ? 2 : 1, round);
    const auto x = static_cast<float>(shift.uniform());
    return {x, static_cast<float>(shift.uniform())};
}

glm::vec2 face_sample(bool is_triangle, uint32_t key, uint32_t index) {
    const std::vector<glm::vec2>& set = is_triangle ? triangle_samples() : square_samples();
    const auto round = static_cast<uint32_t>(index / set.size());
    return HairStrandKernel::placed_sample(set[index % set.size()], sample_shift(is_triangle, round),
                                           round == 0, is_triangle, key);
}

}  // namespace strandlab
