#include "primitives/rocaps.h"

#include "base/parallel.h"
#include "primitives/curved_pieces.h"
#include "primitives/kernel.h"

#include <bit>
#include <cmath>
#include <limits>

namespace strandlab {
namespace kernels {

template <class real, bool counts>
struct RocapsKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/piece_test.h"
#include "shaders/shared/ray_frame.h"
#include "shaders/shared/ray_jet.h"
#include "shaders/primitives/lss.h"
#include "shaders/primitives/rocaps.h"
#include "shaders/primitives/rocaps_gentle.h"
#include "shaders/primitives/rocaps_published.h"
#include "shaders/primitives/rocaps_verified.h"
};

}  // namespace kernels

namespace {

enum ConstantId : uint32_t { verified = 16, epsilon_bits = 17, open_ends = 18 };

template <class Real>
glm::vec<4, Real> control_point(const glm::vec4& stored) {
    return {stored.x, stored.y, stored.z, std::abs(stored.w)};
}

template <class Real, bool counts = false>
bool intersect(const Geometry& geometry, size_t index, const Ray& ray, Real tmax, LeafHit<Real>& hit) {
    using Kernel = kernels::RocapsKernel<Real, counts>;
    const Leaf leaf = geometry.leaves[index];
    const Curve& record = curve_record(geometry, leaf);
    const glm::vec<3, Real> origin(ray.origin), direction(ray.direction);
    const auto c0 = control_point<Real>(record[0]), c1 = control_point<Real>(record[1]),
               c2 = control_point<Real>(record[2]), c3 = control_point<Real>(record[3]);
    const bool begins = std::signbit(record[0].w), ends = std::signbit(record[3].w);
    const bool open = geometry.constant(open_ends) != 0;
    if (geometry.constant(verified) == 0)
        return Kernel::rocaps_published(origin, direction, Real(ray.tmin), tmax, c0, c1, c2, c3, leaf.piece(),
                                        leaf.pieces(), begins, ends, open, hit.t, hit.u, hit.normal);
    const Real first_u = Real(leaf.piece()) / Real(leaf.pieces());
    const Real last_u = Real(leaf.piece() + 1) / Real(leaf.pieces());
    bool found = false;
    if (Kernel::rocaps_gentle(origin, direction, Real(ray.tmin), tmax, c0, c1, c2, c3, first_u, last_u,
                              open && (begins || ends), true, true, found, hit.t, hit.u, hit.normal))
        return found;
    const auto epsilon = Real(std::bit_cast<float>(geometry.constant(epsilon_bits)));
    return Kernel::rocaps_verified(origin, direction, Real(ray.tmin), tmax, c0, c1, c2, c3, first_u, last_u,
                                   begins, ends, open, epsilon, hit.t, hit.u, hit.normal);
}

std::vector<ParameterInfo> parameters() {
    ParameterInfo splits = splits_parameter(0);
    splits.help += "; 0: 4, or 1 for published";
    splits.low = 0;
    return {{.name = "variant",
             .help = "capsules as published, or verified on the true curve",
             .default_value = "verified",
             .choices = {"published", "verified"}},
            {.name = "epsilon",
             .help = "verified: how far the axis of a capsule may leave the curve, in radii",
             .default_value = "0.02",
             .low = 0.001,
             .high = 0.5},
            splits};
}

bool counted(const Geometry& geometry, size_t index, const Ray& ray, float tmax, LeafHit<float>& hit,
             uint32_t& iterations) {
    kernels::iteration_count = 0;
    const bool found = intersect<float, true>(geometry, index, ray, tmax, hit);
    iterations += kernels::iteration_count;
    return found;
}

Surface surface(const Curves& curves, const BuildOptions& options) {
    return curved_surface(curves, Surface::Sweep::sphere, options.caps);
}

void mark_strand_ends(const Curves& curves, Geometry& geometry) {
    auto* records = reinterpret_cast<Curve*>(geometry.curve_records.bytes.data());
    const auto mark = [](float& radius, bool marked) { radius = std::copysign(radius, marked ? -1.f : 1.f); };
    parallel_for(curves.curves.size(), [&](size_t i) {
        const auto curve = static_cast<uint32_t>(i);
        mark(records[i][0].w, curves.begins_strand(curve));
        mark(records[i][3].w, curves.ends_strand(curve));
    });
}

Geometry build(const Curves& curves, const BuildOptions& options) {
    const bool is_verified = options.parameters.is("variant", "verified");
    uint32_t splits = options.parameters.integer("splits");
    if (splits == 0) splits = is_verified ? 4 : 1;
    const std::vector<uint32_t> pieces =
        curved_pieces(curves, splits, std::numeric_limits<double>::infinity(), options.leaf_budget);
    Geometry geometry = build_curved(curves, pieces, false);
    mark_strand_ends(curves, geometry);
    const auto epsilon = static_cast<float>(options.parameters.number("epsilon"));
    geometry.constants = {{verified, is_verified ? 1u : 0u},
                          {epsilon_bits, std::bit_cast<uint32_t>(epsilon)},
                          {open_ends, options.caps == Caps::open ? 1u : 0u}};
    return geometry;
}

Tolerance tolerance(const BuildOptions& options) {
    if (options.parameters.is("variant", "verified")) return {};
    return {
        .reason = "published capsules are chords of the bend, and their frame rounds to ulps of the distance",
        .judged = false};
}

}  // namespace

Primitive rocaps() {
    return {
        .name = "rocaps",
        .summary = "roving capsules on the exact cubic, as published or verified on the true curve",
        .parameters = parameters(),
        .caps = {Caps::round, Caps::open},
        .surface = surface,
        .build = build,
        .shaders = {.intersection = "rocaps.rint", .closest_hit = "curve.rchit", .any_hit = ""},
        .cpu = {.single = intersect<float>, .precise = intersect<double>, .counted = counted},
        .spawn = {.radii = 0.01, .ulps = 16},
        .tolerance = tolerance,
    };
}

}  // namespace strandlab
