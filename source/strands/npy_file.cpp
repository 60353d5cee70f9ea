#include "base/error.h"
#include "base/npy.h"
#include "strands/files.h"
#include "strands/search.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace strandlab {
namespace {

const NpyItem curve_item{"<f4", {4, 4}};
const NpyItem strand_item{"<i4", {2}};

bool is_joined(const Curve& a, const Curve& b) { return std::memcmp(&a[3], &b[0], sizeof(glm::vec3)) == 0; }

/// Runs of curves that share end points.
std::vector<StrandRange> joined_runs(const std::vector<Curve>& curves) {
    std::vector<StrandRange> strands;
    for (uint32_t i = 0; i < curves.size(); ++i) {
        if (i == 0 || !is_joined(curves[i - 1], curves[i])) strands.push_back({i, 0});
        ++strands.back().count;
    }
    return strands;
}

std::vector<StrandRange> read_strands(const ByteSource& source, size_t curve_count, ImportReport& report) {
    std::vector<StrandRange> strands;
    uint64_t next = 0;
    const auto rows = read_npy<std::array<int32_t, 2>>(source, strand_item);
    strands.reserve(rows.size());
    for (size_t s = 0; s < rows.size(); ++s) {
        const auto [first, count] = rows[s];
        if (first < 0 || count < 0 || uint64_t(first) != next || next + uint64_t(count) > curve_count)
            fail(ExitCode::bad_input,
                 "{}: row {} is ({}, {}): must begin at curve {} and end within {} curves", source.name(), s,
                 first, count, next, curve_count);
        next += uint64_t(count);
        if (count > 0)
            strands.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(count)});
        else
            ++report.short_strands;
    }
    if (next != curve_count)
        fail(ExitCode::bad_input, "{}: {} rows end at curve {}, there are {} curves", source.name(),
             rows.size(), next, curve_count);
    return strands;
}

void check_curves(const ByteSource& source, const std::vector<Curve>& curves, uint64_t data_offset) {
    const auto bad =
        first_where(curves.size() * 4, [&](size_t i) { return !is_usable(curves[i / 4][i % 4]); });
    if (!bad) return;
    const glm::vec4& p = curves[*bad / 4][*bad % 4];
    fail(ExitCode::bad_input,
         "{}: [{}, {}] at offset {} is ({:g}, {:g}, {:g}, {:g}): every number must be finite and below {:g}",
         source.name(), *bad / 4, *bad % 4, data_offset + *bad * sizeof(glm::vec4), p.x, p.y, p.z, p.w,
         largest_coordinate);
}

size_t count_gaps(const Curves& curves) {
    size_t gaps = 0;
    for (const StrandRange& strand : curves.strands)
        for (uint32_t i = strand.first + 1; i < strand.first + strand.count; ++i)
            gaps += !is_joined(curves.curves[i - 1], curves.curves[i]);
    return gaps;
}

bool same_ranges(const std::vector<StrandRange>& a, const std::vector<StrandRange>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const StrandRange& x, const StrandRange& y) {
        return x.first == y.first && x.count == y.count;
    });
}

}  // namespace

Curves load_npy_curves(const ByteSource& source, const ByteSource* strands, ImportReport& report) {
    const NpyHeader header = require_npy(source, curve_item);
    if (header.shape[0] > uint64_t(std::numeric_limits<int32_t>::max()))
        fail(ExitCode::bad_input, "{}: {} curves are above the limit of 2^31 - 1", source.name(),
             header.shape[0]);
    Curves result;
    result.curves = source.array<Curve>(header.data_offset, header.shape[0], "curves");
    check_curves(source, result.curves, header.data_offset);
    result.strands =
        strands ? read_strands(*strands, result.curves.size(), report) : joined_runs(result.curves);
    if (strands) report.gaps += count_gaps(result);
    return result;
}

void write_npy_curves(const std::string& path, const Curves& curves, const WriteOptions& options) {
    if (curves.curves.size() > size_t(std::numeric_limits<int32_t>::max()))
        fail(ExitCode::bad_input, "{}: {} curves are above the limit of 2^31 - 1", path,
             curves.curves.size());
    if (options.strands_path.empty() && !same_ranges(curves.strands, joined_runs(curves.curves)))
        fail(ExitCode::bad_input,
             "{}: the end points alone would not give the {} strands back: write a strands file as well",
             path, curves.strands.size());
    write_npy<Curve>(path, curve_item, curves.curves);
    if (options.strands_path.empty()) return;
    static_assert(sizeof(StrandRange) == 2 * sizeof(int32_t));
    write_npy<StrandRange>(options.strands_path, strand_item, curves.strands);
}

}  // namespace strandlab
