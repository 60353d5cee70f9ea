#include "scene/leaf_order.h"

#include "base/cache.h"
#include "base/hash.h"
#include "base/parallel.h"

#include <fmt/core.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cstring>
#include <optional>

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

/// Fewer are ordered faster than a file is found.
constexpr size_t fewest_kept = 50'000;

/// The entry as an order of `count` boxes; nothing when it is none.
std::optional<std::vector<uint32_t>> order_in(std::span<const std::byte> entry, size_t count) {
    if (entry.size() != count * sizeof(uint32_t)) return std::nullopt;
    std::vector<uint32_t> order(count);
    std::memcpy(order.data(), entry.data(), entry.size());
    std::vector<bool> seen(count, false);
    for (const uint32_t index : order) {
        if (index >= count || seen[index]) return std::nullopt;
        seen[index] = true;
    }
    return order;
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

KnownOrder known_median_order(std::span<const Box> boxes) {
    if (boxes.size() < fewest_kept) return {median_order(boxes), false};
    const std::string key =
        fmt::format("leaf-order/1 boxes={} hash={:016x}", boxes.size(), Hash().add(boxes).value());
    if (const auto entry = cache_read(key))
        if (auto order = order_in(*entry, boxes.size())) return {std::move(*order), true};
    KnownOrder computed{median_order(boxes), false};
    cache_write(key, std::as_bytes(std::span(computed.order)));
    return computed;
}

}  // namespace strandlab
