// Loops over all cores whose results do not depend on how many there are.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>

namespace strandlab {

/// Calls body(i) for each i in [0, count), in any order, on the threads that --threads allows.
/// The body must write only what belongs to item i.
template <class Body>
void parallel_for(size_t count, Body&& body) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count), [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
}

}  // namespace strandlab
