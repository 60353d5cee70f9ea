#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "strands/bezier.h"
#include "strands/files.h"
#include "strands/search.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace strandlab {
namespace {

enum Flag : uint32_t {
    has_segments = 1,
    has_points = 2,
    has_thickness = 4,
    has_transparency = 8,
    has_colour = 16
};
constexpr uint32_t all_flags = 31;
constexpr uint64_t most_segments = std::numeric_limits<uint16_t>::max();

struct Header {
    char magic[4] = {'H', 'A', 'I', 'R'};
    uint32_t strands = 0, points = 0, flags = 0;
    uint32_t default_segments = 0;
    float default_thickness = 0, default_transparency = 0, default_colour[3] = {0.4f, 0.3f, 0.2f};
    char text[88] = "made by Strandlab";
};
static_assert(sizeof(Header) == 128);

Header read_header(const ByteSource& source) {
    const auto header = source.value<Header>(0, "header");
    if (std::memcmp(header.magic, "HAIR", 4) != 0)
        fail(ExitCode::bad_input, "{}: not a .hair file (it does not begin with HAIR)", source.name());
    if (!(header.flags & has_points) || (header.flags & ~all_flags))
        fail(ExitCode::bad_input,
             "{}: flags {:#x} at offset 12 must hold 0x2 (points) and nothing above {:#x}", source.name(),
             header.flags, all_flags);
    uint64_t length = sizeof(Header) + uint64_t(header.points) * 12;
    if (header.flags & has_segments) length += uint64_t(header.strands) * 2;
    if (header.flags & has_thickness) length += uint64_t(header.points) * 4;
    if (header.flags & has_transparency) length += uint64_t(header.points) * 4;
    if (header.flags & has_colour) length += uint64_t(header.points) * 12;
    if (length != source.size())
        fail(ExitCode::bad_input,
             "{}: {} strands and {} points with flags {:#x} need {} bytes, the file has {}: it is truncated "
             "or damaged",
             source.name(), header.strands, header.points, header.flags, length, source.size());
    return header;
}

/// First point of every strand; the sum must be the header's number of points.
std::vector<uint32_t> read_first_points(const ByteSource& source, const Header& header) {
    std::vector<uint16_t> segments;
    if (header.flags & has_segments)
        segments = source.array<uint16_t>(sizeof(Header), header.strands, "segments");
    uint64_t sum = uint64_t(header.strands) * (uint64_t(header.default_segments) + 1);
    if (header.flags & has_segments) {
        sum = 0;
        for (const uint16_t n : segments) sum += uint64_t(n) + 1;
    }
    if (sum != header.points)
        fail(ExitCode::bad_input,
             "{}: the strands have {} points together ({}), the header says {} at offset 8", source.name(),
             sum,
             segments.empty() ? fmt::format("{} segments each", header.default_segments)
                              : "segments array at 128",
             header.points);
    std::vector<uint32_t> first(size_t(header.strands) + 1);
    for (size_t s = 0; s < header.strands; ++s)
        first[s + 1] = first[s] + 1 + (segments.empty() ? header.default_segments : segments[s]);
    return first;
}

void read_radii(const ByteSource& source, uint64_t offset, std::vector<glm::vec4>& points,
                ImportReport& report) {
    const auto thickness = source.array<float>(offset, points.size(), "thickness");
    if (const auto bad = first_where(
            points.size(), [&](size_t i) { return !(std::abs(thickness[i]) <= largest_coordinate); }))
        fail(ExitCode::bad_input, "{}: thickness {} of point {} at offset {} must be finite and below {:g}",
             source.name(), thickness[*bad], *bad, offset + *bad * sizeof(float), largest_coordinate);
    for (size_t i = 0; i < points.size(); ++i) {
        report.negative_radii += thickness[i] < 0;
        points[i].w = std::max(0.5f * thickness[i], 0.0f);
    }
}

/// Segments of every strand when written with k points per curve.
std::vector<uint16_t> segment_counts(const std::string& path, const Curves& curves, uint32_t k) {
    std::vector<uint16_t> segments;
    segments.reserve(curves.strands.size());
    for (const StrandRange& strand : curves.strands) {
        const uint64_t n = uint64_t(strand.count) * k;
        if (n > most_segments)
            fail(ExitCode::bad_input,
                 "{}: strand {} needs {} points, .hair holds at most {} a strand: write fewer points per "
                 "curve, or .npy",
                 path, segments.size(), n + 1, most_segments + 1);
        segments.push_back(static_cast<uint16_t>(n));
    }
    return segments;
}

}  // namespace

Strands load_hair(const ByteSource& source, ImportReport& report) {
    const Header header = read_header(source);
    Strands strands;
    strands.first_point = read_first_points(source, header);
    const uint64_t offset = sizeof(Header) + (header.flags & has_segments ? uint64_t(header.strands) * 2 : 0);
    strands.points = read_points(source, offset, header.points, 3);
    if (header.flags & has_thickness)
        read_radii(source, offset + uint64_t(header.points) * 12, strands.points, report);
    else if (header.default_thickness > 0 && header.default_thickness <= largest_coordinate)
        for (glm::vec4& point : strands.points) point.w = 0.5f * header.default_thickness;
    return strands;
}

void write_hair(const std::string& path, const Curves& curves, const WriteOptions& options) {
    const uint32_t k = std::max(options.points_per_curve, 1u);
    const std::vector<uint16_t> segments = segment_counts(path, curves, k);
    const uint64_t count = uint64_t(curves.curves.size()) * k + curves.strands.size();
    if (count > std::numeric_limits<uint32_t>::max())
        fail(ExitCode::bad_input, "{}: {} points are above the limit of .hair, 2^32 - 1", path, count);
    std::vector<glm::vec3> points(count);
    std::vector<float> thickness(count);
    parallel_for(curves.strands.size(), [&](size_t s) {
        const StrandRange strand = curves.strands[s];
        size_t at = size_t(strand.first) * k + s;  // every strand before has one point more than segments
        const auto put = [&](const glm::vec4& p) {
            points[at] = glm::vec3(p);
            thickness[at++] = 2 * p.w;
        };
        put(curves.curves[strand.first][0]);
        for (uint32_t c = strand.first; c < strand.first + strand.count; ++c) {
            const CurveD curve = to_double(curves.curves[c]);
            for (uint32_t j = 1; j < k; ++j) put(glm::vec4(point_at(curve, double(j) / k)));
            put(curves.curves[c][3]);
        }
    });

    Header header;
    header.strands = static_cast<uint32_t>(curves.strands.size());
    header.points = static_cast<uint32_t>(count);
    header.flags = has_points | has_thickness;
    const bool even =
        std::adjacent_find(segments.begin(), segments.end(), std::not_equal_to<>()) == segments.end();
    if (!even) header.flags |= has_segments;
    if (even && !segments.empty()) header.default_segments = segments.front();
    FileWriter file(path);
    file.write(&header, sizeof(header));
    if (!even) file.write(segments.data(), segments.size() * sizeof(uint16_t));
    file.write(points.data(), points.size() * sizeof(glm::vec3));
    file.write(thickness.data(), thickness.size() * sizeof(float));
    file.commit();
}

}  // namespace strandlab
