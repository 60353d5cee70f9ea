#include "trace/reference.h"

#include "base/parallel.h"
#include "base/progress.h"

#include <glm/glm.hpp>

#include <cmath>

namespace strandlab {
namespace {

/// In radii; the margin of the radius itself moves a grazing hit by less than 0.05.
constexpr double place_margin = 0.3;

bool same_strand(const Curves& curves, const ReferenceHit& a, const ReferenceHit& b) {
    if (a.is_hit() != b.is_hit()) return false;
    return !a.is_hit() || a.curve == b.curve || curves.strand_of(a.curve) == curves.strand_of(b.curve);
}

bool same_place(const Ray& ray, const ReferenceHit& a, const ReferenceHit& b) {
    if (!a.is_hit() || !b.is_hit()) return a.is_hit() == b.is_hit();
    return std::abs(a.t - b.t) * glm::length(glm::dvec3(ray.direction)) <= place_margin * a.radius;
}

}  // namespace

Reference make_reference(const Surface& surface, const Curves& curves, std::span<const Ray> rays,
                         const DecisiveMargin& margin) {
    const OracleOptions larger{1 + margin.radius, margin.ulps, margin.ends};
    const OracleOptions smaller{1 - margin.radius, margin.ulps, -margin.ends};
    const Oracle oracle(surface, larger);
    Reference reference;
    reference.hits.resize(rays.size());
    reference.decisive.resize(rays.size());
    reference.decisive_place.resize(rays.size());
    Progress progress("reference hits", rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        const ReferenceHit hit = oracle.trace(rays[i], OracleOptions{});
        const ReferenceHit outer = oracle.trace(rays[i], larger), inner = oracle.trace(rays[i], smaller);
        reference.hits[i] = hit;
        reference.decisive[i] = same_strand(curves, hit, outer) && same_strand(curves, hit, inner);
        reference.decisive_place[i] =
            reference.decisive[i] && same_place(rays[i], hit, outer) && same_place(rays[i], hit, inner);
        progress.tick();
    });
    return reference;
}

}  // namespace strandlab
