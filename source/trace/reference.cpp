#include "trace/reference.h"

#include "base/parallel.h"

namespace strandlab {
namespace {

bool same_strand(const Curves& curves, const ReferenceHit& a, const ReferenceHit& b) {
    if (a.is_hit() != b.is_hit()) return false;
    return !a.is_hit() || a.curve == b.curve || curves.strand_of(a.curve) == curves.strand_of(b.curve);
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
    parallel_for(rays.size(), [&](size_t i) {
        const ReferenceHit hit = oracle.trace(rays[i], OracleOptions{});
        reference.hits[i] = hit;
        reference.decisive[i] = same_strand(curves, hit, oracle.trace(rays[i], larger)) &&
                                same_strand(curves, hit, oracle.trace(rays[i], smaller));
    });
    return reference;
}

}  // namespace strandlab
