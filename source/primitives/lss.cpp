#include "primitives/lss.h"

#include "base/parallel.h"
#include "primitives/kernel.h"
#include "primitives/pieces.h"

#include <cstring>

namespace strandlab {
namespace kernels {

template <class real>
struct LssKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/piece_test.h"
#include "shaders/shared/ray_frame.h"
#include "shaders/primitives/lss.h"
};

}  // namespace kernels

namespace {

enum ConstantId : uint32_t { open_ends = 16 };

std::span<const LssRecord> records_of(const Geometry& geometry) {
    return {reinterpret_cast<const LssRecord*>(geometry.leaf_records.bytes.data()),
            geometry.leaf_records.size()};
}

template <class Real>
bool intersect(const Geometry& geometry, size_t index, const Ray& ray, Real tmax, LeafHit<Real>& hit) {
    using Kernel = kernels::LssKernel<Real>;
    const LssRecord& record = records_of(geometry)[index];
    const Leaf leaf = geometry.leaves[index];
    const bool open = geometry.constant(open_ends) != 0;
    return Kernel::lss_intersect(glm::vec<3, Real>(ray.origin), glm::vec<3, Real>(ray.direction),
                                 Real(ray.tmin), tmax, glm::vec<4, Real>(record.start),
                                 glm::vec<4, Real>(record.end), leaf.piece(), leaf.pieces(),
                                 open && (leaf.flags() & Leaf::begins_strand),
                                 open && (leaf.flags() & Leaf::ends_strand), true, hit.t, hit.u, hit.normal);
}

Surface surface(const Curves& curves, const BuildOptions& options) {
    return straight_surface(curves, straight_pieces(curves, options.parameters), options.caps);
}

Geometry build(const Curves& curves, const BuildOptions& options) {
    const std::vector<uint32_t> pieces = straight_pieces(curves, options.parameters);
    const bool open = options.caps == Caps::open;
    Geometry geometry;
    make_leaves(curves, pieces, open, geometry);
    geometry.boxes.resize(geometry.leaves.size());
    geometry.leaf_records.stride = sizeof(LssRecord);
    geometry.leaf_records.bytes.resize(geometry.leaves.size() * sizeof(LssRecord));
    parallel_for(geometry.leaves.size(), [&](size_t i) {
        const Leaf leaf = geometry.leaves[i];
        const Curve& curve = curves.curves[leaf.curve];
        const LssRecord record{joint(curve, leaf.piece(), leaf.pieces()),
                               joint(curve, leaf.piece() + 1, leaf.pieces())};
        std::memcpy(&geometry.leaf_records.bytes[i * sizeof record], &record, sizeof record);
        geometry.boxes[i] = bounds_of(record.start, record.end);
    });
    geometry.constants = {{open_ends, open ? 1u : 0u}};
    return geometry;
}

}  // namespace

Primitive lss() {
    return {
        .name = "lss",
        .summary = "linear swept spheres: round cones in closed form, one per straight piece",
        .parameters = straight_piece_parameters(4),
        .caps = {Caps::round, Caps::open},
        .surface = surface,
        .build = build,
        .shaders = {.intersection = "lss.rint", .closest_hit = "curve.rchit", .any_hit = ""},
        .cpu = {intersect<float>, intersect<double>},
        .spawn = {.radii = 1e-3, .ulps = 8},
    };
}

}  // namespace strandlab
