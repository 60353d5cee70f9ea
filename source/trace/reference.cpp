#include "trace/reference.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "trace/coherent_order.h"
#include "trace/surface_variation.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

/// In radii; the margin of the radius itself moves a grazing hit by less than 0.05.
constexpr double place_margin = 0.3;

bool same_strand(const Curves& curves, const ReferenceHit& a, const ReferenceHit& b) {
    if (a.is_hit() != b.is_hit()) return false;
    if (!a.is_hit()) return true;
    return a.instance == b.instance &&
           (a.curve == b.curve || curves.strand_of(a.curve) == curves.strand_of(b.curve));
}

bool same_place(const Ray& ray, const ReferenceHit& a, const ReferenceHit& b) {
    if (!a.is_hit() || !b.is_hit()) return a.is_hit() == b.is_hit();
    return std::abs(a.t - b.t) * glm::length(glm::dvec3(ray.direction)) <= place_margin * a.radius;
}

}  // namespace

Decided decided(const Ray& ray, const Curves& curves, const ReferenceHit& hit, const ReferenceHit& larger,
                const ReferenceHit& smaller) {
    Decided result;
    result.strand = same_strand(curves, hit, larger) && same_strand(curves, hit, smaller);
    result.place = result.strand && same_place(ray, hit, larger) && same_place(ray, hit, smaller);
    return result;
}

namespace {

/// Whether smaller radii give a solid that lies within the larger one, so that no ray from outside enters it
/// sooner. Open ends and discs, which may be entered unseen, do not nest.
bool is_nested(const Surface& surface) {
    return surface.sweep == Surface::Sweep::sphere && surface.caps == Caps::round &&
           surface.triangles.empty();
}

double relative_change(const DecisiveMargin& margin, double size, double radius) {
    return std::max(margin.radius, margin.ulps * oracle::float_ulp(size) / radius);
}

/// Mean radius of a piece.
double mean_radius(const SurfacePiece& piece) {
    const auto& c = piece.control;
    const double ends = double(c[0].w) + double(c[3].w);
    return piece.straight ? ends / 2 : (ends + double(c[1].w) + double(c[2].w)) / 4;
}

double relative_change(const DecisiveMargin& margin, const SurfaceTriangle& triangle) {
    double size = 0, radius = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 along = glm::abs(triangle.vertex[i] - triangle.vertex[0]);
        size = std::max({size, double(along.x), double(along.y), double(along.z)});
        radius = std::max(radius, double(glm::distance(triangle.vertex[i], triangle.centre[i])));
    }
    return relative_change(margin, size, radius);
}

/// A parameter at which a ray cannot have hit a surface within the one that it enters at `outer`.
double before(const ReferenceHit& outer) { return outer.t - 1e-9 * outer.t; }

}  // namespace

double relative_margin(const Surface& surface, const DecisiveMargin& margin) {
    const size_t pieces = surface.pieces.size();
    std::vector<double> changes(pieces + surface.triangles.size());
    if (changes.empty()) return margin.radius;
    parallel_for(changes.size(), [&](size_t i) {
        changes[i] = i < pieces ? relative_change(margin, oracle::local_size(surface.pieces[i]),
                                                  mean_radius(surface.pieces[i]))
                                : relative_change(margin, surface.triangles[i - pieces]);
    });
    const auto middle = changes.begin() + static_cast<std::ptrdiff_t>((changes.size() - 1) / 2);
    std::nth_element(changes.begin(), middle, changes.end());
    return *middle;
}

Reference make_reference(const Surface& surface, const Curves& curves, std::span<const Ray> rays,
                         const DecisiveMargin& margin) {
    const OracleOptions larger{1 + margin.radius, margin.ulps, margin.ends};
    const OracleOptions smaller{1 - margin.radius, margin.ulps, -margin.ends};
    const Oracle oracle(surface, larger);
    const bool nested = is_nested(surface);
    Reference reference;
    reference.margin = relative_margin(surface, margin);
    reference.hits.resize(rays.size());
    reference.decisive.resize(rays.size());
    reference.decisive_place.resize(rays.size());
    Progress progress("reference hits", rays.size());
    const std::vector<uint32_t> order = coherent_order(rays);
    parallel_for(rays.size(), [&](size_t at) {
        const size_t i = order[at];
        bool stays_clear = false;
        const ReferenceHit outer = oracle.trace(rays[i], larger, stays_clear);
        const bool from_outside = nested && !outer.starts_inside;
        if (stays_clear || (from_outside && !outer.is_hit())) {  // of the largest surface, hence of all three
            reference.decisive[i] = reference.decisive_place[i] = 1;
            return;
        }
        const ReferenceHit hit = oracle.trace(rays[i], OracleOptions{}, from_outside ? before(outer) : 0.0);
        ReferenceHit inner;
        if (!(from_outside && !hit.is_hit()))
            inner = oracle.trace(rays[i], smaller, from_outside ? before(hit) : 0.0);
        const Decided is_decided = decided(rays[i], curves, hit, outer, inner);
        reference.hits[i] = hit;
        reference.decisive[i] = is_decided.strand;
        reference.decisive_place[i] = is_decided.place;
        progress.tick();
    });
    return reference;
}

}  // namespace strandlab
