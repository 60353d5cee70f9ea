#include "trace/bvh.h"

#include "base/parallel.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab {
namespace {

constexpr int bin_count = 16;
constexpr uint32_t leaf_size = 2;
/// Subtrees with fewer items are built by one thread.
constexpr size_t parallel_size = 4096;
/// Below this depth left, nodes are halved by count, which bounds the depth for any input.
constexpr int halving_depth = 40;

double half_area(const Box& box) {
    if (box.is_empty()) return 0;
    const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

bool is_usable(const Box& box) {
    for (int i = 0; i < 3; ++i)
        if (!(box.low[i] <= box.high[i]) || !std::isfinite(box.low[i]) || !std::isfinite(box.high[i]))
            return false;
    return true;
}

/// An item as the builder moves it: its box travels along, so that every pass reads memory in order.
struct BuildItem {
    Box box;
    uint32_t index;

    double centre(int axis) const { return 0.5 * (double(box.low[axis]) + double(box.high[axis])); }
};

struct Bin {
    Box box;
    size_t count = 0;
};

/// Boxes of the items and of their centres.
struct Extent {
    Box box;
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const BuildItem& item) {
        box.add(item.box);
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], item.centre(i));
            high[i] = std::max(high[i], item.centre(i));
        }
    }
};

/// A split plane: items with bin_of(item) < bin go left.
struct Split {
    int axis = -1, bin = 0;
    double low = 0, scale = 0;

    int bin_of(const BuildItem& item) const {
        return std::clamp(static_cast<int>((item.centre(axis) - low) * scale), 0, bin_count - 1);
    }
};

Split best_split(std::span<const BuildItem> items, const Extent& extent) {
    Split best;
    double best_cost = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double width = extent.high[axis] - extent.low[axis];
        if (!(width > 0)) continue;
        Split split{axis, 0, extent.low[axis], bin_count / width};
        if (!std::isfinite(split.scale)) continue;
        std::array<Bin, bin_count> bins;
        for (const BuildItem& item : items) {
            Bin& bin = bins[split.bin_of(item)];
            bin.box.add(item.box);
            ++bin.count;
        }
        std::array<double, bin_count> right_cost{};
        Bin right;
        for (int i = bin_count - 1; i > 0; --i) {
            right.box.add(bins[i].box);
            right.count += bins[i].count;
            right_cost[i] = half_area(right.box) * static_cast<double>(right.count);
        }
        Bin left;
        for (int i = 1; i < bin_count; ++i) {
            left.box.add(bins[i - 1].box);
            left.count += bins[i - 1].count;
            if (left.count == 0 || left.count == items.size()) continue;
            const double cost = half_area(left.box) * static_cast<double>(left.count) + right_cost[i];
            if (cost < best_cost) {
                best_cost = cost;
                split.bin = i;
                best = split;
            }
        }
    }
    return best;
}

}  // namespace

/// Builds subtrees in place. A subtree over n items owns 2 n - 1 consecutive nodes (some unused where
/// leaves hold several items), so that node numbers do not depend on who builds first.
struct Bvh::Builder {
    Bvh& bvh;
    std::vector<BuildItem> items;

    size_t partition(size_t first, size_t count, const Extent& extent, int depth) {
        std::span<BuildItem> part(&items[first], count);
        if (depth < halving_depth) {
            const Split split = best_split(part, extent);
            if (split.axis >= 0) {
                const auto middle = std::partition(part.begin(), part.end(), [&](const BuildItem& item) {
                    return split.bin_of(item) < split.bin;
                });
                return static_cast<size_t>(middle - part.begin());
            }
        }
        const glm::dvec3 size = extent.high - extent.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        std::nth_element(part.begin(), part.begin() + static_cast<ptrdiff_t>(count / 2), part.end(),
                         [axis](const BuildItem& a, const BuildItem& b) {
                             const double ca = a.centre(axis), cb = b.centre(axis);
                             return ca < cb || (ca == cb && a.index < b.index);
                         });
        return count / 2;
    }

    void build(size_t node_index, size_t first, size_t count, int depth) {
        Node& node = bvh.nodes_[node_index];
        Extent extent;
        for (size_t i = first; i < first + count; ++i) extent.add(items[i]);
        node.box = extent.box;
        if (count <= leaf_size) {
            node.first = static_cast<uint32_t>(first);
            node.count = static_cast<uint32_t>(count);
            return;
        }
        const size_t left_count = partition(first, count, extent, depth);
        const size_t left = node_index + 1, right = node_index + 2 * left_count;
        node.first = static_cast<uint32_t>(right);
        node.count = 0;
        const auto build_left = [&] { build(left, first, left_count, depth + 1); };
        const auto build_right = [&] { build(right, first + left_count, count - left_count, depth + 1); };
        if (count < parallel_size) {
            build_left();
            build_right();
        } else {
            tbb::parallel_invoke(build_left, build_right);
        }
    }
};

Bvh::Bvh(std::span<const Box> boxes) {
    Builder builder{*this, {}};
    builder.items.reserve(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i)
        if (is_usable(boxes[i])) builder.items.push_back({boxes[i], static_cast<uint32_t>(i)});
    const size_t count = builder.items.size();
    if (count == 0) return;
    nodes_.resize(2 * count - 1);
    builder.build(0, 0, count, 0);
    items_.resize(count);
    parallel_for(count, [&](size_t i) { items_[i] = builder.items[i].index; });
}

}  // namespace strandlab
