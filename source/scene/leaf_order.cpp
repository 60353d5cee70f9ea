#include "scene/leaf_order.h"

#include "base/parallel.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>

namespace strandlab {
namespace {

struct Item {
    Box box;
    uint32_t index;

    float centre(int axis) const { return box.low[axis] + box.high[axis]; }  // twice the centre
};

float half_area(const Box& box) {
    const glm::vec3 size = box.high - box.low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

float area_of(std::span<const Item> items) {
    Box box;
    for (const Item& item : items) box.add(item.box);
    return half_area(box);
}

void split_at_median(std::span<Item> items, size_t left, int axis) {
    std::nth_element(items.begin(), items.begin() + left, items.end(), [axis](const Item& a, const Item& b) {
        const float ca = a.centre(axis), cb = b.centre(axis);
        return ca < cb || (ca == cb && a.index < b.index);
    });
}

/// Below this an axis cannot separate the halves noticeably better than the longest one.
constexpr float shortest_axis = 0.3f;
constexpr size_t parallel_items = 8192;

void order_items(std::span<Item> items) {
    if (items.size() < 3) return;
    const size_t left = (items.size() + 1) / 2;
    Box centres;
    for (const Item& item : items) centres.add(item.box.low + item.box.high);
    const glm::vec3 size = centres.high - centres.low;
    const float longest = std::max({size.x, size.y, size.z});
    int best_axis = -1, last_axis = -1;
    float best_area = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (!(size[axis] >= shortest_axis * longest)) continue;
        split_at_median(items, left, axis);
        last_axis = axis;
        const float area = area_of(items.first(left)) + area_of(items.subspan(left));
        if (best_axis >= 0 && !(area < best_area)) continue;
        best_axis = axis;
        best_area = area;
    }
    if (best_axis != last_axis) split_at_median(items, left, best_axis);
    const auto first = items.first(left), second = items.subspan(left);
    if (items.size() < parallel_items) {
        order_items(first);
        order_items(second);
    } else {
        tbb::parallel_invoke([=] { order_items(first); }, [=] { order_items(second); });
    }
}

}  // namespace

std::vector<uint32_t> median_order(std::span<const Box> boxes) {
    std::vector<Item> items(boxes.size());
    parallel_for(items.size(), [&](size_t i) { items[i] = {boxes[i], static_cast<uint32_t>(i)}; });
    order_items(items);
    std::vector<uint32_t> order(items.size());
    parallel_for(items.size(), [&](size_t i) { order[i] = items[i].index; });
    return order;
}

}  // namespace strandlab
