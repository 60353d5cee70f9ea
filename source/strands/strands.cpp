#include "strands/strands.h"

#include "base/error.h"
#include "base/parallel.h"
#include "strands/bezier.h"
#include "strands/search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

namespace strandlab {
namespace {

constexpr size_t strands_per_block = 256;

glm::vec4 scaled(const glm::vec4& point, float scale) { return glm::vec4(glm::dvec4(point) * double(scale)); }

void check_points(const Strands& strands, float scale) {
    const auto bad = first_where(strands.points.size(),
                                 [&](size_t i) { return !is_usable(scaled(strands.points[i], scale)); });
    if (!bad) return;
    const auto after = std::upper_bound(strands.first_point.begin(), strands.first_point.end(), *bad);
    const auto strand = after - strands.first_point.begin() - 1;
    const glm::vec4& p = strands.points[*bad];
    fail(ExitCode::bad_input,
         "point {} of strand {} is ({:g}, {:g}, {:g}) with radius {:g}, times unit scale {:g}: every number "
         "must be "
         "finite and below {:g}",
         *bad - strands.first_point[strand], strand, p.x, p.y, p.z, p.w, scale, largest_coordinate);
}

/// The distinct points of one strand in scene units, all with radii.
void gather_points(const Strands& strands, size_t strand, const CurveOptions& options,
                   std::vector<glm::dvec4>& points, ImportReport& report) {
    points.clear();
    bool missing = options.override_radii;
    for (uint32_t i = strands.first_point[strand]; i < strands.first_point[strand + 1]; ++i) {
        const glm::vec4 point = scaled(strands.points[i], options.unit_scale);
        if (!points.empty() && glm::vec3(points.back()) == glm::vec3(point)) {
            ++report.repeated_points;
            continue;
        }
        points.emplace_back(point);
        missing |= point.w < 0;
    }
    if (points.size() < 2) {
        ++report.short_strands;
        points.clear();
    }
    if (!missing || points.empty()) return;
    report.radii_from_options |= !options.override_radii;
    for (size_t i = 0; i < points.size(); ++i) {
        if (!options.override_radii && points[i].w >= 0) continue;
        const double u = double(i) / double(points.size() - 1);
        points[i].w = (1 - u) * double(options.root_radius) + u * double(options.tip_radius);
    }
}

double knot_interval(Basis basis, const glm::dvec4& a, const glm::dvec4& b) {
    return basis == Basis::centripetal ? std::sqrt(glm::length(glm::dvec3(b - a))) : 1.0;
}

glm::dvec4 reflected(const glm::dvec4& end, const glm::dvec4& next) { return 2.0 * end - next; }

Curve line(const glm::dvec4& a, const glm::dvec4& b) {
    return to_float({a, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0, b});
}

/// The Bezier form of the curve from p1 to p2 (Yuksel et al. 2011), d being the knot intervals. An
/// interval never is 0 as neighbours are distinct. Written in differences, so that no digits of large
/// coordinates cancel.
Curve catmull_rom(const glm::dvec4* p, double d0, double d1, double d2) {
    const glm::dvec4 chord = p[2] - p[1];
    CurveD c{p[1], p[1] + (d0 * d0 * chord + d1 * d1 * (p[1] - p[0])) / (3 * d0 * (d0 + d1)),
             p[2] - (d2 * d2 * chord + d1 * d1 * (p[3] - p[2])) / (3 * d2 * (d1 + d2)), p[2]};
    // Uneven points whose radii jump would make bulges that no point has.
    const double largest = std::max({p[0].w, p[1].w, p[2].w, p[3].w});
    for (const int i : {1, 2}) c[i].w = std::clamp(c[i].w, 0.0, 2 * largest);
    return to_float(c);
}

Curve bspline(const glm::dvec4* b) {
    return to_float({(b[0] + 4.0 * b[1] + b[2]) / 6.0, (2.0 * b[1] + b[2]) / 3.0, (b[1] + 2.0 * b[2]) / 3.0,
                     (b[1] + 4.0 * b[2] + b[3]) / 6.0});
}

/// Curves between the points; points gets one reflected point before and after.
void make_strand(Basis basis, std::vector<glm::dvec4>& points, Curve* out) {
    const size_t n = points.size();
    if (n == 2 || basis == Basis::linear) {
        for (size_t i = 0; i + 1 < n; ++i) out[i] = line(points[i], points[i + 1]);
        return;
    }
    glm::dvec4 before = reflected(points[0], points[1]), after = reflected(points[n - 1], points[n - 2]);
    before.w = std::max(before.w, 0.0), after.w = std::max(after.w, 0.0);
    points.insert(points.begin(), before);
    points.push_back(after);
    for (size_t i = 0; i + 1 < n; ++i) {
        const glm::dvec4* p = &points[i];
        out[i] = basis == Basis::bspline
                     ? bspline(p)
                     : catmull_rom(p, knot_interval(basis, p[0], p[1]), knot_interval(basis, p[1], p[2]),
                                   knot_interval(basis, p[2], p[3]));
    }
}

void add(ImportReport& sum, const ImportReport& part) {
    sum.short_strands += part.short_strands;
    sum.repeated_points += part.repeated_points;
    sum.negative_radii += part.negative_radii;
    sum.gaps += part.gaps;
    sum.radii_from_options |= part.radii_from_options;
}

/// Lays the strands out one after another: first curve and number of curves for each, in order.
std::vector<StrandRange> plan(const Strands& strands, const CurveOptions& options, ImportReport& report) {
    std::vector<StrandRange> ranges(strands.size());
    const size_t blocks = (strands.size() + strands_per_block - 1) / strands_per_block;
    std::vector<ImportReport> reports(blocks);
    parallel_for(blocks, [&](size_t block) {
        std::vector<glm::dvec4> points;
        const size_t end = std::min(strands.size(), (block + 1) * strands_per_block);
        for (size_t s = block * strands_per_block; s < end; ++s) {
            gather_points(strands, s, options, points, reports[block]);
            ranges[s].count = points.empty() ? 0 : static_cast<uint32_t>(points.size() - 1);
        }
    });
    for (const ImportReport& part : reports) add(report, part);
    uint64_t first = 0;
    for (StrandRange& range : ranges) {
        range.first = static_cast<uint32_t>(first);
        first += range.count;
    }
    assert(first <= strands.points.size());
    return ranges;
}

}  // namespace

void check_options(const CurveOptions& options) {
    if (!(options.unit_scale >= 1e-9f && options.unit_scale <= 1e9f))
        fail(ExitCode::usage, "unit scale {:g} is not a number from 1e-9 to 1e9 (--unit-scale)",
             options.unit_scale);
    const auto check_radius = [](float radius, const char* option) {
        if (!(radius >= 0 && radius <= largest_coordinate))
            fail(ExitCode::usage, "radius {:g} is not a number from 0 to {:g} ({})", radius,
                 largest_coordinate, option);
    };
    check_radius(options.root_radius, "--radius");
    check_radius(options.tip_radius, "--radius-tip");
}

bool is_usable(const glm::vec4& point) {
    return std::abs(point.x) <= largest_coordinate && std::abs(point.y) <= largest_coordinate &&
           std::abs(point.z) <= largest_coordinate && std::abs(point.w) <= largest_coordinate;
}

Curves make_curves(const Strands& strands, const CurveOptions& options, ImportReport& report) {
    check_options(options);
    if (strands.points.size() > std::numeric_limits<uint32_t>::max())
        fail(ExitCode::bad_input, "{} points are above the limit of 2^32 - 1", strands.points.size());
    check_points(strands, options.unit_scale);
    const std::vector<StrandRange> ranges = plan(strands, options, report);
    Curves result;
    result.curves.resize(ranges.empty() ? 0 : size_t(ranges.back().first) + ranges.back().count);
    const size_t blocks = (strands.size() + strands_per_block - 1) / strands_per_block;
    parallel_for(blocks, [&](size_t block) {
        std::vector<glm::dvec4> points;
        ImportReport counted_already;
        const size_t end = std::min(strands.size(), (block + 1) * strands_per_block);
        for (size_t s = block * strands_per_block; s < end; ++s) {
            if (ranges[s].count == 0) continue;
            gather_points(strands, s, options, points, counted_already);
            make_strand(options.basis, points, &result.curves[ranges[s].first]);
        }
    });
    result.strands.reserve(ranges.size());
    std::copy_if(ranges.begin(), ranges.end(), std::back_inserter(result.strands),
                 [](const StrandRange& range) { return range.count > 0; });
    return result;
}

void apply_options(Curves& curves, const CurveOptions& options, ImportReport& report) {
    check_options(options);
    std::vector<size_t> negative((curves.strands.size() + strands_per_block - 1) / strands_per_block);
    parallel_for(negative.size(), [&](size_t block) {
        const size_t end = std::min(curves.strands.size(), (block + 1) * strands_per_block);
        for (size_t s = block * strands_per_block; s < end; ++s) {
            const StrandRange strand = curves.strands[s];
            for (size_t i = 0; i < size_t(strand.count) * 4; ++i) {
                glm::vec4& point = curves.curves[strand.first + i / 4][i % 4];
                if (options.unit_scale != 1.0f) point = scaled(point, options.unit_scale);
                if (options.override_radii) {
                    const double u = (double(i / 4) + double(i % 4) / 3) / strand.count;
                    point.w = static_cast<float>((1 - u) * double(options.root_radius) +
                                                 u * double(options.tip_radius));
                }
                if (point.w >= 0) continue;
                negative[block] += point.w < 0;
                point.w = point.w < 0 ? 0.0f : point.w;  // NaN stays, to be refused
            }
        }
    });
    for (const size_t n : negative) report.negative_radii += n;
    const auto bad = first_where(curves.curves.size() * 4,
                                 [&](size_t i) { return !is_usable(curves.curves[i / 4][i % 4]); });
    if (!bad) return;
    const glm::vec4& p = curves.curves[*bad / 4][*bad % 4];
    fail(ExitCode::bad_input,
         "control point {} of curve {} is ({:g}, {:g}, {:g}) with radius {:g}: every number must be finite "
         "and below "
         "{:g}",
         *bad % 4, *bad / 4, p.x, p.y, p.z, p.w, largest_coordinate);
}

}  // namespace strandlab
