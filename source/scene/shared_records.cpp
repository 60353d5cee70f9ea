#include "scene/shared_records.h"

#include "base/parallel.h"

#include <atomic>
#include <cassert>
#include <cstring>

namespace strandlab {
namespace {

bool overlaps_next(const Records& records, size_t i) {
    const std::byte* next = records.bytes.data() + (i + 1) * records.stride;
    return std::memcmp(next - records.overlap, next, records.overlap) == 0;
}

}  // namespace

uint32_t overlapping_in_a_row(const Records& records) {
    const size_t count = records.size();
    if (records.overlap == 0 || count < 2) return 0;
    size_t row = 1;
    while (row < count && overlaps_next(records, row - 1)) ++row;
    if (row == 1 || row > 0xFFFFFFFFu) return 0;
    std::atomic<bool> is_regular = true;
    parallel_for(count - 1, [&](size_t i) {
        if ((i + 1) % row != 0 && !overlaps_next(records, i)) is_regular = false;
    });
    return is_regular ? static_cast<uint32_t>(row) : 0;
}

std::vector<std::byte> without_overlaps(const Records& records, uint32_t row) {
    assert(row > 0 && records.overlap > 0);
    const size_t count = records.size(), step = records.stride - records.overlap;
    const auto place = [&](size_t i) { return i * step + i / row * records.overlap; };
    std::vector<std::byte> bytes(count == 0 ? 0 : place(count - 1) + records.stride);
    // One row at a time: neighbours write the same bytes.
    parallel_for((count + row - 1) / row, [&](size_t r) {
        for (size_t i = r * row; i < std::min(count, (r + 1) * row); ++i)
            std::memcpy(bytes.data() + place(i), records.bytes.data() + i * records.stride, records.stride);
    });
    return bytes;
}

}  // namespace strandlab
