// Rays aimed at a surface, and the oracle's answers for them.
#include "base/parallel.h"
#include "measure/stress.h"
#include "strands/bezier.h"
#include "trace/oracle.h"
#include "trace/surface_variation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

constexpr double radius_margin = 1e-3, ulp_margin = 8, end_margin = 1e-3, place_margin = 0.3;
/// A hit whose radius is below this share of the strand's largest has no place that could be right.
constexpr double vanishing = 1e-6;

CurveD straight(const glm::dvec4& a, const glm::dvec4& b) {
    return {a, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0, b};
}

StressTarget target_of(const SurfacePiece& piece) {
    const CurveD axis = to_double(piece.control);
    return {piece.straight ? straight(axis[0], axis[3]) : axis, glm::dvec3(0)};
}

/// The centre line under a triangle and the direction of its width.
StressTarget target_of(const SurfaceTriangle& triangle) {
    const auto centre = [&](int i) {
        const glm::dvec3 c(triangle.centre[i]);
        return glm::dvec4(c, glm::length(glm::dvec3(triangle.vertex[i]) - c));
    };
    const glm::dvec4 a = centre(0);
    const glm::dvec4 b = triangle.centre[1] != triangle.centre[0] ? centre(1) : centre(2);
    return {straight(a, b), glm::dvec3(triangle.vertex[0]) - glm::dvec3(triangle.centre[0])};
}

std::vector<StressTarget> targets_of(const Surface& part) {
    std::vector<StressTarget> targets;
    for (const SurfacePiece& piece : part.pieces) targets.push_back(target_of(piece));
    for (const SurfaceTriangle& triangle : part.triangles) targets.push_back(target_of(triangle));
    return targets;
}

/// Largest radius and largest local coordinate of a strand's part, for the margin that is reported.
struct Size {
    double radius = 0, coordinate = 0;
};

Size size_of(const Surface& part) {
    Size size;
    for (const SurfacePiece& piece : part.pieces) {
        size.coordinate = std::max(size.coordinate, oracle::local_size(piece));
        for (const glm::vec4& p : piece.control) size.radius = std::max(size.radius, double(p.w));
    }
    for (const SurfaceTriangle& triangle : part.triangles)
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 v(triangle.vertex[i]);
            size.radius = std::max(size.radius, glm::length(v - glm::dvec3(triangle.centre[i])));
            const glm::dvec3 edge = glm::abs(v - glm::dvec3(triangle.vertex[0]));
            size.coordinate = std::max({size.coordinate, edge.x, edge.y, edge.z});
        }
    return size;
}

/// The ray with its interval lengthened by so many ulp at both ends (shortened when negative).
oracle::ExactRay stretched(const Ray& ray, double ulps) {
    const auto moved = [&](float t, double sign) {
        return std::max(0.0, double(t) + sign * ulps * oracle::float_ulp(double(t)));
    };
    return {glm::dvec3(ray.origin), glm::dvec3(ray.direction), moved(ray.tmin, -1), moved(ray.tmax, 1)};
}

/// Radius times curvature of the axis at a hit.
double bend_at(const Surface& part, const ReferenceHit& hit) {
    const SurfacePiece* piece = piece_at(part, hit.curve, hit.u);
    if (piece == nullptr || piece->straight) return 0;
    const CurveD c = to_double(piece->control);
    const glm::dvec3 d(derivative_at(c, hit.u)), second(second_derivative_at(c, hit.u));
    const double speed = glm::length(d);
    return hit.radius * glm::length(glm::cross(d, second)) / (speed * speed * speed);
}

/// The surface whose ends at kinks move as open ends of strands do.
Surface opened_at_kinks(const Surface& part) {
    Surface opened = part;
    for (SurfacePiece& piece : opened.pieces) piece.begins_strand = piece.ends_strand = true;
    return opened;
}

StressAnswer answer(const Surface& part, const Ray& ray, bool has_kinks) {
    StressAnswer result;
    const Size size = size_of(part);
    const double least = ulp_margin * oracle::float_ulp(size.coordinate);
    result.margin = size.radius > 0 ? std::max(radius_margin, least / size.radius) : 1;
    if (!is_valid(ray)) {
        result.decisive = true;  // a miss
        return result;
    }
    const OracleOptions larger{1 + radius_margin, ulp_margin, end_margin};
    const OracleOptions smaller{1 - radius_margin, ulp_margin, -end_margin};
    const bool opens = has_kinks && part.sweep == Surface::Sweep::disc && part.caps == Caps::open;
    const Surface opened = opens ? opened_at_kinks(part) : Surface{};
    const Surface& varied = opens ? opened : part;
    const Oracle oracle(varied, larger);
    const ReferenceHit hit = opens ? Oracle(part).trace(ray) : oracle.trace(ray, OracleOptions{});
    const ReferenceHit outer = oracle.trace(stretched(ray, ulp_margin), larger);
    const oracle::ExactRay shorter = stretched(ray, -ulp_margin);
    const ReferenceHit inner = shorter.tmin <= shorter.tmax ? oracle.trace(shorter, smaller) : ReferenceHit{};
    result.is_hit = hit.is_hit();
    result.t = hit.t;
    result.radius = hit.radius;
    const double length = glm::length(glm::dvec3(ray.direction));
    const auto same = [&](const ReferenceHit& other) { return other.is_hit() == hit.is_hit(); };
    const auto same_place = [&](const ReferenceHit& other) {
        return !hit.is_hit() || std::abs(other.t - hit.t) * length <= place_margin * hit.radius;
    };
    const bool vanishes = hit.is_hit() && !(hit.radius > vanishing * size.radius);
    result.decisive = !vanishes && same(outer) && same(inner) && outer.starts_inside == hit.starts_inside &&
                      inner.starts_inside == hit.starts_inside;
    result.decisive_place = result.decisive && same_place(outer) && same_place(inner);
    result.folded = hit.is_hit() && part.sweep == Surface::Sweep::disc && !(bend_at(part, hit) < most_bend);
    return result;
}

}  // namespace

const SurfacePiece* piece_at(const Surface& surface, uint32_t curve, double u) {
    const SurfacePiece* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const SurfacePiece& piece : surface.pieces) {
        const double away = std::max({0.0, double(piece.u0) - u, u - double(piece.u1)});
        if (piece.curve != curve || !(away < least)) continue;
        best = &piece;
        least = away;
    }
    return best;
}

std::vector<Surface> strand_surfaces(const Surface& surface, uint64_t strands, uint32_t curves) {
    std::vector<Surface> parts(strands);
    for (Surface& part : parts) part.sweep = surface.sweep, part.caps = surface.caps;
    for (const SurfacePiece& piece : surface.pieces) parts[piece.curve / curves].pieces.push_back(piece);
    for (const SurfaceTriangle& triangle : surface.triangles)
        parts[triangle.curve / curves].triangles.push_back(triangle);
    return parts;
}

Curves stress_strands(const StressRange& range) {
    const uint32_t n = range.family->curves;
    Curves curves;
    curves.curves.resize(range.count * n);
    curves.strands.resize(range.count);
    parallel_for(range.count, [&](size_t i) {
        const std::vector<Curve> strand = make_strand(*range.family, range.seed, range.first + i);
        assert(strand.size() == n);
        std::copy(strand.begin(), strand.end(), &curves.curves[i * n]);
        curves.strands[i] = {static_cast<uint32_t>(i * n), n};
    });
    return curves;
}

StressPairs aimed_pairs(const StressRange& range, const Surface& surface) {
    const std::vector<Surface> parts = strand_surfaces(surface, range.count, range.family->curves);
    StressPairs pairs{range, std::vector<Ray>(range.count), {}};
    parallel_for(range.count, [&](size_t i) {
        pairs.rays[i] = make_ray(*range.family, range.seed, range.first + i, targets_of(parts[i]));
    });
    return pairs;
}

StressPairs stress_pairs(const StressRange& range, const Surface& surface) {
    const std::vector<Surface> parts = strand_surfaces(surface, range.count, range.family->curves);
    StressPairs pairs{range, std::vector<Ray>(range.count), std::vector<StressAnswer>(range.count)};
    parallel_for(range.count, [&](size_t i) {
        pairs.rays[i] = make_ray(*range.family, range.seed, range.first + i, targets_of(parts[i]));
        pairs.answers[i] = answer(parts[i], pairs.rays[i], range.family->kink > 0);
    });
    return pairs;
}

}  // namespace strandlab
