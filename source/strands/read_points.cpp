#include "base/error.h"
#include "base/parallel.h"
#include "strands/files.h"
#include "strands/search.h"

#include <algorithm>
#include <limits>

namespace strandlab {

std::vector<glm::vec4> read_points(const ByteSource& source, uint64_t offset, uint64_t count,
                                   size_t floats_per_point) {
    const size_t stride = floats_per_point * sizeof(float);
    source.require(offset, count, stride, "points");
    if (count > std::numeric_limits<uint32_t>::max())
        fail(ExitCode::bad_input, "{}: {} points are above the limit of 2^32 - 1", source.name(), count);
    std::vector<glm::vec4> points(count);
    constexpr size_t block = 65536;
    parallel_for((count + block - 1) / block, [&](size_t b) {
        const size_t begin = b * block, end = std::min<size_t>(count, begin + block);
        const auto floats =
            source.array<float>(offset + begin * stride, (end - begin) * floats_per_point, "points");
        for (size_t i = begin; i < end; ++i) {
            const float* p = &floats[(i - begin) * floats_per_point];
            points[i] = {p[0], p[1], p[2], -1.0f};
        }
    });
    if (const auto bad = first_where(count, [&](size_t i) { return !is_usable(points[i]); }))
        fail(ExitCode::bad_input,
             "{}: point {} at offset {} is ({:g}, {:g}, {:g}): must be finite and below {:g}", source.name(),
             *bad, offset + *bad * stride, points[*bad].x, points[*bad].y, points[*bad].z,
             largest_coordinate);
    return points;
}

}  // namespace strandlab
