#include "primitives/null_primitive.h"

#include "primitives/curved_pieces.h"

#include <limits>

namespace strandlab {
namespace {

Surface surface(const Curves&, const BuildOptions& options) {
    Surface nothing;
    nothing.caps = options.caps;
    return nothing;
}

Geometry build(const Curves& curves, const BuildOptions& options) {
    Geometry geometry =
        build_curved(curves,
                     curved_pieces(curves, options.parameters.integer("splits"),
                                   std::numeric_limits<double>::infinity(), options.leaf_budget),
                     false);
    geometry.curve_records = {};
    return geometry;
}

template <class Real>
bool intersect(const Geometry&, size_t, const Ray&, Real, LeafHit<Real>&) {
    return false;
}

}  // namespace

Primitive null_primitive() {
    return {
        .name = "null",
        .summary = "boxes of the exact cubic and an intersector that always misses: the floor of traversal",
        .parameters = {splits_parameter(4)},
        .caps = {Caps::round, Caps::open, Caps::flat},
        .diagnostic = true,
        .surface = surface,
        .build = build,
        .shaders = {.intersection = "null.rint", .closest_hit = "curve.rchit", .any_hit = ""},
        .cpu = {intersect<float>, intersect<double>},
    };
}

}  // namespace strandlab
