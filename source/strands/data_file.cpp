#include "base/error.h"
#include "strands/files.h"

#include <cstring>
#include <limits>

namespace strandlab {
namespace {

constexpr uint64_t point_bytes = 3 * sizeof(float);

int32_t count_at(const ByteSource& source, const std::vector<std::byte>& bytes, uint64_t offset,
                 std::string_view what) {
    if (bytes.size() < sizeof(int32_t) || offset > bytes.size() - sizeof(int32_t))
        fail(ExitCode::bad_input,
             "{}: {} expected at offset {}, the file has {} bytes: it is truncated or damaged", source.name(),
             what, offset, bytes.size());
    int32_t count;
    std::memcpy(&count, &bytes[offset], sizeof(count));
    if (count < 0)
        fail(ExitCode::bad_input, "{}: {} {} at offset {} is negative: not a .data hair file", source.name(),
             what, count, offset);
    return count;
}

glm::vec4 point_in(const ByteSource& source, const std::vector<std::byte>& bytes, uint64_t offset) {
    float p[3];
    std::memcpy(p, &bytes[offset], sizeof(p));
    const glm::vec4 point(p[0], p[1], p[2], -1.0f);
    if (!is_usable(point))
        fail(ExitCode::bad_input,
             "{}: point at offset {} is ({:g}, {:g}, {:g}): must be finite and below {:g}", source.name(),
             offset, p[0], p[1], p[2], largest_coordinate);
    return point;
}

}  // namespace

Strands load_data(const ByteSource& source, ImportReport&) {
    const auto bytes = source.array<std::byte>(0, source.size(), "contents");
    const auto strand_count = static_cast<uint64_t>(count_at(source, bytes, 0, "number of strands"));
    uint64_t offset = sizeof(int32_t);
    source.require(offset, strand_count, sizeof(int32_t), "strands");
    if (bytes.size() / point_bytes > std::numeric_limits<uint32_t>::max())
        fail(ExitCode::bad_input, "{}: {} bytes hold more than the limit of 2^32 - 1 points", source.name(),
             bytes.size());
    Strands strands;
    strands.first_point.reserve(strand_count + 1);
    strands.points.reserve((bytes.size() - offset - strand_count * sizeof(int32_t)) / point_bytes);
    for (uint64_t s = 0; s < strand_count; ++s) {
        const auto n = static_cast<uint64_t>(count_at(source, bytes, offset, "number of points"));
        offset += sizeof(int32_t);
        source.require(offset, n, point_bytes, "points");
        for (uint64_t i = 0; i < n; ++i, offset += point_bytes)
            strands.points.push_back(point_in(source, bytes, offset));
        strands.first_point.push_back(static_cast<uint32_t>(strands.points.size()));
    }
    if (offset != bytes.size())
        fail(ExitCode::bad_input, "{}: {} strands end at offset {}, the file has {} bytes", source.name(),
             strand_count, offset, bytes.size());
    return strands;
}

}  // namespace strandlab
