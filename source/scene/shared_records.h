// Records whose ends are the beginnings of the next, as the points where two curves of a strand meet.
#pragma once

#include "scene/geometry.h"

namespace strandlab {

/// How many records overlap in a row, where all rows are as long (the last may be shorter): record i ends
/// with the Records::overlap bytes that record i + 1 begins with, unless i + 1 is a multiple of the result. 0
/// where that is not so, or no two records overlap.
uint32_t overlapping_in_a_row(const Records& records);

/// The records without the end of each that the next one repeats. Record i begins at
/// i (stride - overlap) + (i / row) overlap bytes.
std::vector<std::byte> without_overlaps(const Records& records, uint32_t row);

}  // namespace strandlab
