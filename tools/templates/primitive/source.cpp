#include "primitives/NAME.h"

#include "base/parallel.h"
#include "primitives/kernel.h"
#include "primitives/pieces.h"

#include <cstring>

namespace strandlab {
namespace kernels {

template <class real>
struct TypeKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/ray_frame.h"
#include "shaders/primitives/NAME.h"
};

}  // namespace kernels

namespace {

std::span<const TypeRecord> records_of(const Geometry& geometry) {
    return {reinterpret_cast<const TypeRecord*>(geometry.leaf_records.bytes.data()), geometry.leaf_records.size()};
}

template <class Real>
bool intersect(const Geometry& geometry, size_t index, const Ray& ray, Real tmax, LeafHit<Real>& hit) {
    const TypeRecord& record = records_of(geometry)[index];
    const Leaf leaf = geometry.leaves[index];
    return kernels::TypeKernel<Real>::NAME_intersect(
        glm::vec<3, Real>(ray.origin), glm::vec<3, Real>(ray.direction), Real(ray.tmin), tmax,
        glm::vec<4, Real>(record.start), glm::vec<4, Real>(record.end), leaf.piece(), leaf.pieces(), hit.t, hit.u,
        hit.normal);
}

/// The surface that the records decode to, whatever the intersector makes of it: the oracle's input.
/// As it stands: a ball swept along each straight piece.
Surface surface(const Curves& curves, const BuildOptions& options) {
    return straight_surface(curves, straight_pieces(curves, options.parameters), options.caps);
}

/// A record and a box for every leaf. The box must hold all of the surface that the record decodes to.
Geometry build(const Curves& curves, const BuildOptions& options) {
    Geometry geometry;
    make_leaves(curves, straight_pieces(curves, options.parameters), false, geometry);
    geometry.boxes.resize(geometry.leaves.size());
    geometry.leaf_records.stride = sizeof(TypeRecord);
    geometry.leaf_records.bytes.resize(geometry.leaves.size() * sizeof(TypeRecord));
    parallel_for(geometry.leaves.size(), [&](size_t i) {
        const Leaf leaf = geometry.leaves[i];
        const Curve& curve = curves.curves[leaf.curve];
        const TypeRecord record{joint(curve, leaf.piece(), leaf.pieces()),
                                joint(curve, leaf.piece() + 1, leaf.pieces())};
        std::memcpy(&geometry.leaf_records.bytes[i * sizeof record], &record, sizeof record);
        geometry.boxes[i] = bounds_of(record.start, record.end);
    });
    return geometry;
}

}  // namespace

Primitive NAME() {
    return {
        .name = "NAME",
        .summary = "to be written: what it is and how it is intersected",
        .parameters = straight_piece_parameters(4),
        .caps = {Caps::round},
        .surface = surface,
        .build = build,
        .shaders = {.intersection = "NAME.rint", .closest_hit = "curve.rchit", .any_hit = ""},
        .cpu = {intersect<float>, intersect<double>},
    };
}

}  // namespace strandlab
