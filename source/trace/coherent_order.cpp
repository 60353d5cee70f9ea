#include "trace/coherent_order.h"

#include "base/parallel.h"
#include "scene/bounds.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace strandlab {
namespace {

/// Below this, sorting costs more than it gains.
constexpr size_t fewest = 4096;

/// Every third bit of the lowest ten.
uint64_t spread_bits(uint32_t x) {
    uint64_t bits = x & 1023u;
    bits = (bits | (bits << 16)) & 0x30000FFu;
    bits = (bits | (bits << 8)) & 0x300F00Fu;
    bits = (bits | (bits << 4)) & 0x30C30C3u;
    return (bits | (bits << 2)) & 0x9249249u;
}

/// The cell of a number in [low, high]; 0 for what is no number.
uint32_t cell(float value, float low, float high, uint32_t cells) {
    const float share = (value - low) / (high - low);
    return share > 0 ? std::min(cells - 1, static_cast<uint32_t>(std::min(share, 1.0f) * float(cells))) : 0u;
}

uint64_t morton(const glm::vec3& point, const glm::vec3& low, const glm::vec3& high, uint32_t cells) {
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis)
        code |= spread_bits(cell(point[axis], low[axis], high[axis], cells)) << axis;
    return code;
}

}  // namespace

std::vector<uint32_t> coherent_order(std::span<const Ray> rays) {
    std::vector<uint32_t> order(rays.size());
    std::iota(order.begin(), order.end(), 0u);
    if (rays.size() < fewest) return order;
    Box origins;
    for (const Ray& ray : rays)
        if (is_valid(ray)) origins.add(ray.origin);
    std::vector<std::pair<uint64_t, uint32_t>> keys(rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        const glm::vec3 direction = glm::normalize(rays[i].direction);
        const uint64_t place = morton(rays[i].origin, origins.low, origins.high, 1024);
        keys[i] = {place << 15 | morton(direction, glm::vec3(-1), glm::vec3(1), 32),
                   static_cast<uint32_t>(i)};
    });
    tbb::parallel_sort(keys.begin(), keys.end());
    parallel_for(keys.size(), [&](size_t i) { order[i] = keys[i].second; });
    return order;
}

}  // namespace strandlab
