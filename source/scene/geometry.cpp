#include "scene/geometry.h"

#include "base/parallel.h"

#include <cassert>
#include <cstring>

namespace strandlab {
namespace {

template <class T>
void permute(std::vector<T>& items, const std::vector<uint32_t>& order) {
    if (items.empty()) return;
    std::vector<T> old(items.size());
    old.swap(items);
    parallel_for(order.size(), [&](size_t i) { items[i] = old[order[i]]; });
}

void permute(Records& records, const std::vector<uint32_t>& order) {
    if (records.stride == 0) return;
    std::vector<std::byte> old(records.bytes.size());
    old.swap(records.bytes);
    const size_t stride = records.stride;
    parallel_for(order.size(),
                 [&](size_t i) { std::memcpy(&records.bytes[i * stride], &old[order[i] * stride], stride); });
}

}  // namespace

std::vector<Box> leaf_boxes(const Geometry& geometry) {
    if (!geometry.is_triangles()) return geometry.boxes;
    std::vector<Box> boxes(geometry.triangles.size());
    parallel_for(boxes.size(), [&](size_t i) {
        for (int k = 0; k < 3; ++k) boxes[i].add(geometry.vertices[geometry.triangles[i][k]]);
    });
    return boxes;
}

void reorder_leaves(Geometry& geometry, const std::vector<uint32_t>& order) {
    assert(order.size() == geometry.leaf_count());
    bool changes = false;
    for (size_t i = 0; i < order.size() && !changes; ++i) changes = order[i] != i;
    if (!changes) return;
    permute(geometry.boxes, order);
    permute(geometry.triangles, order);
    permute(geometry.leaves, order);
    permute(geometry.leaf_records, order);
    geometry.uniform_pieces = 0;
}

}  // namespace strandlab
