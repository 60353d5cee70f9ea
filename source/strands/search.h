// The first item that fails a test, found by all cores, the same for any number of threads.
#pragma once

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace strandlab {

/// Lowest i in [0, count) for which is_bad(i) holds.
template <class Predicate>
std::optional<size_t> first_where(size_t count, Predicate&& is_bad) {
    constexpr size_t block = 16384;
    std::vector<size_t> firsts((count + block - 1) / block, count);
    parallel_for(firsts.size(), [&](size_t b) {
        for (size_t i = b * block, end = std::min(count, i + block); i < end; ++i) {
            if (!is_bad(i)) continue;
            firsts[b] = i;
            return;
        }
    });
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](size_t i) { return i < count; });
    if (found == firsts.end()) return std::nullopt;
    return *found;
}

}  // namespace strandlab
