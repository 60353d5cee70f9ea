#include "trace/reach_grid.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

constexpr auto relaxed = std::memory_order_relaxed;

/// Cells along the longest side: about eight cells a curve, within limits.
constexpr double fewest_cells = 32, most_cells = 128;

/// A beam of several rays may be as wide as this, in cells; a wider one is split.
constexpr double widest_beam = 2;

/// Of a cell: more than doubles round here.
constexpr double slack = 1e-6;

bool is_finite(const Box& box) {
    bool finite = true;
    for (int i = 0; i < 3; ++i) finite = finite && std::isfinite(box.low[i]) && std::isfinite(box.high[i]);
    return finite;
}

/// The nearest cell within the grid. What is not negative is rounded down by the conversion.
int cell_of(double coordinate, int size) {
    return static_cast<int>(std::clamp(coordinate, 0.0, double(size - 1)));
}

}  // namespace

Box hull_box(std::span<const Curve> curves, float width) {
    Box box;
    for (const Curve& curve : curves)
        for (const glm::vec4& point : curve) {
            box.add(glm::vec3(point) - width * point.w);
            box.add(glm::vec3(point) + width * point.w);
        }
    return box;
}

/// What holds some segments with a common axis, from coordinate `from` to `to` along it.
struct ReachGrid::Beam {
    int axis = 0;
    double from = std::numeric_limits<double>::infinity(), to = -from;
    glm::dvec3 low_from{from}, high_from{-from}, low_to{from}, high_to{-from};
    bool has_one_axis = true;

    explicit Beam(std::span<const Segment> segments) : axis(segments.front().axis) {
        for (const Segment& segment : segments) {
            has_one_axis = has_one_axis && segment.axis == axis;
            from = std::min(from, segment.from);
            to = std::max(to, segment.to);
        }
        if (!has_one_axis) return;
        for (const Segment& segment : segments) {
            const glm::dvec3 begin = segment.at(from), end = segment.at(to);
            low_from = glm::min(low_from, begin);
            high_from = glm::max(high_from, begin);
            low_to = glm::min(low_to, end);
            high_to = glm::max(high_to, end);
        }
    }

    bool is_narrow() const {
        const glm::dvec3 width = glm::max(high_from - low_from, high_to - low_to);
        return has_one_axis && std::max({width.x, width.y, width.z}) <= widest_beam;
    }
};

ReachGrid::ReachGrid(const Curves& curves, double reach_margin, double margin) {
    for (const Curve& curve : curves.curves) bounds_.add(box_of(curve));
    const glm::vec3 reach = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
    margin_ = static_cast<float>(reach_margin * double(std::max({reach.x, reach.y, reach.z})) + margin);
    if (!bounds_.is_empty()) {
        bounds_ = enlarged(bounds_);
        all_met_ = !is_finite(bounds_);
    }
    if (!bounds_.is_empty() && !all_met_) {
        const glm::dvec3 extent = glm::dvec3(bounds_.high) - glm::dvec3(bounds_.low);
        const double longest = std::max({extent.x, extent.y, extent.z});
        const double cells =
            std::clamp(2 * std::cbrt(double(curves.curves.size())), fewest_cells, most_cells);
        if (longest > 0) cell_ = longest / cells;
        for (int i = 0; i < 3; ++i) size_[i] = 1 + static_cast<int>(extent[i] / cell_);
    }
    cells_ = std::vector<std::atomic<uint8_t>>(size_t(size_.x) * size_t(size_.y) * size_t(size_.z));
}

std::optional<ReachGrid::Segment> ReachGrid::clip(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  double tmin, double tmax) const {
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    double near = tmin, far = tmax;
    for (int i = 0; i < 3; ++i) {
        const double low = double(bounds_.low[i]), high = double(bounds_.high[i]);
        if (direction[i] == 0) {
            if (!(origin[i] >= low && origin[i] <= high)) return std::nullopt;
            continue;
        }
        const double a = (low - origin[i]) / direction[i], b = (high - origin[i]) / direction[i];
        near = std::max(near, std::min(a, b) * (1 - rounding));
        far = std::min(far, std::max(a, b) * (1 + rounding));
    }
    if (!(near <= far)) return std::nullopt;
    const glm::dvec3 size = glm::abs(direction);
    Segment segment;
    segment.axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int axis = segment.axis;
    segment.slope = direction / direction[axis];
    // From a point within the grid: an origin may be far away.
    const glm::dvec3 entry = (origin + near * direction - glm::dvec3(bounds_.low)) / cell_;
    const double begin = entry[axis], end = begin + (far - near) * direction[axis] / cell_;
    segment.origin = entry - segment.slope * begin;
    segment.from = std::min(begin, end);
    segment.to = std::max(begin, end);
    return segment;
}

void ReachGrid::mark(std::span<const Segment> segments) {
    if (segments.empty() || all_met_) return;
    const Beam beam(segments);
    if (segments.size() == 1 || beam.is_narrow()) {
        mark(beam);
        return;
    }
    const size_t half = segments.size() / 2;
    mark(segments.first(half));
    mark(segments.subspan(half));
}

// Slab by slab of cells across the axis.
void ReachGrid::mark(const Beam& beam) {
    const int axis = beam.axis;
    const int first = cell_of(beam.from - slack, size_[axis]), last = cell_of(beam.to + slack, size_[axis]);
    const double length = beam.to - beam.from;
    const glm::dvec3 low_step = length > 0 ? (beam.low_to - beam.low_from) / length : glm::dvec3(0);
    const glm::dvec3 high_step = length > 0 ? (beam.high_to - beam.high_from) / length : glm::dvec3(0);
    for (int slab = first; slab <= last; ++slab) {
        const double begin = std::clamp(slab - beam.from, 0.0, length);
        const double end = std::clamp(slab + 1 - beam.from, 0.0, length);
        const glm::dvec3 low = beam.low_from + glm::min(begin * low_step, end * low_step) - slack;
        const glm::dvec3 high = beam.high_from + glm::max(begin * high_step, end * high_step) + slack;
        glm::ivec3 from, to;
        bool is_inside = true;
        for (int i = 0; i < 3; ++i) {
            is_inside = is_inside && (i == axis || (high[i] >= 0 && low[i] <= size_[i]));
            from[i] = i == axis ? slab : cell_of(low[i], size_[i]);
            to[i] = i == axis ? slab : cell_of(high[i], size_[i]);
        }
        if (is_inside) mark_cells(from, to);
    }
}

void ReachGrid::mark_cells(const glm::ivec3& low, const glm::ivec3& high) {
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                std::atomic<uint8_t>& cell = cells_[index_of({x, y, z})];
                if (cell.load(relaxed) == 0) cell.store(1, relaxed);
            }
}

void ReachGrid::mark_all() { all_met_ = true; }

std::vector<uint32_t> ReachGrid::sums() const {
    const size_t width = size_t(size_.x) + 1, plane = width * (size_t(size_.y) + 1);
    std::vector<uint32_t> sums(plane * (size_t(size_.z) + 1));
    parallel_for(size_t(size_.z), [&](size_t z) {
        for (int y = 0; y < size_.y; ++y) {
            uint32_t row = 0;
            for (int x = 0; x < size_.x; ++x) {
                row += cells_[index_of({x, y, static_cast<int>(z)})].load(relaxed);
                const size_t here = (z + 1) * plane + (size_t(y) + 1) * width + size_t(x) + 1;
                sums[here] = sums[here - width] + row;
            }
        }
    });
    for (size_t z = 1; z < size_t(size_.z); ++z)
        parallel_for(plane, [&](size_t i) { sums[(z + 1) * plane + i] += sums[z * plane + i]; });
    return sums;
}

bool ReachGrid::touches_mark(const Box& box, const std::vector<uint32_t>& sums) const {
    const size_t width = size_t(size_.x) + 1, plane = width * (size_t(size_.y) + 1);
    size_t low[3], high[3];
    for (int i = 0; i < 3; ++i) {
        const double from = (double(box.low[i]) - double(bounds_.low[i])) / cell_;
        const double to = (double(box.high[i]) - double(bounds_.low[i])) / cell_;
        low[i] = static_cast<size_t>(cell_of(from - slack, size_[i]));
        high[i] = static_cast<size_t>(cell_of(to + slack, size_[i])) + 1;
    }
    // Differences of unsigned numbers wrap, and come out right.
    const auto at = [&](size_t x, size_t y, size_t z) { return sums[z * plane + y * width + x]; };
    const auto layer = [&](size_t z) {
        return at(high[0], high[1], z) - at(low[0], high[1], z) - at(high[0], low[1], z) +
               at(low[0], low[1], z);
    };
    return layer(high[2]) - layer(low[2]) != 0;
}

std::vector<uint8_t> ReachGrid::strands_met(const Curves& curves) const {
    std::vector<uint8_t> met(curves.strands.size(), all_met_ ? 1 : 0);
    if (all_met_ || bounds_.is_empty()) return met;
    const std::vector<uint32_t> marked = sums();
    parallel_for(met.size(), [&](size_t s) {
        const StrandRange& strand = curves.strands[s];
        for (uint32_t c = strand.first; c < strand.first + strand.count && met[s] == 0; ++c)
            met[s] = touches_mark(enlarged(box_of(curves.curves[c])), marked) ? 1 : 0;
    });
    return met;
}

}  // namespace strandlab
