#include "primitives/prhi.h"

#include "primitives/curved_pieces.h"
#include "primitives/kernel.h"

#include <limits>

namespace strandlab {
namespace kernels {

template <class real, bool counts>
struct PrhiKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/piece_test.h"
#include "shaders/shared/ray_frame.h"
#include "shaders/shared/ray_jet.h"
#include "shaders/primitives/prhi.h"
#include "shaders/primitives/prhi_gentle.h"
};

}  // namespace kernels

namespace {

enum ConstantId : uint32_t { robust = 16, iterations = 17, flat_ends = 18 };

constexpr double quarter_turn = 1.5707963267948966;

template <class Real, bool counts = false>
bool intersect(const Geometry& geometry, size_t index, const Ray& ray, Real tmax, LeafHit<Real>& hit) {
    using Kernel = kernels::PrhiKernel<Real, counts>;
    using Real4 = glm::vec<4, Real>;
    const Leaf leaf = geometry.leaves[index];
    const Curve& c = curve_record(geometry, leaf);
    const glm::vec<3, Real> origin(ray.origin), direction(ray.direction);
    const Real4 p0(c[0]), p1(c[1]), p2(c[2]), p3(c[3]);
    const Real first_u = Real(leaf.piece()) / Real(leaf.pieces());
    const Real last_u = Real(leaf.piece() + 1) / Real(leaf.pieces());
    const bool flat = geometry.constant(flat_ends) != 0;
    const bool cap_start = flat && (leaf.flags() & Leaf::begins_strand);
    const bool cap_end = flat && (leaf.flags() & Leaf::ends_strand);
    const bool is_robust = geometry.constant(robust) != 0;
    bool found = false;
    if (is_robust &&
        Kernel::prhi_at_once(origin, direction, Real(ray.tmin), tmax, p0, p1, p2, p3, first_u, last_u, true,
                             !cap_start && !cap_end, found, hit.t, hit.u, hit.normal))
        return found;
    return Kernel::prhi_intersect(origin, direction, Real(ray.tmin), tmax, p0, p1, p2, p3, first_u, last_u,
                                  is_robust, geometry.constant(iterations), cap_start, cap_end, hit.t, hit.u,
                                  hit.normal);
}

bool counted(const Geometry& geometry, size_t index, const Ray& ray, float tmax, LeafHit<float>& hit,
             uint32_t& iterations) {
    kernels::iteration_count = 0;
    const bool found = intersect<float, true>(geometry, index, ray, tmax, hit);
    iterations += kernels::iteration_count;
    return found;
}

Surface surface(const Curves& curves, const BuildOptions& options) {
    return curved_surface(curves, Surface::Sweep::disc, options.caps);
}

bool is_robust(const Parameters& parameters) { return parameters.is("variant", "robust"); }

/// A number that defaults, as 0, to what the variant uses.
uint32_t number_or(const Parameters& parameters, const char* name, uint32_t published,
                   uint32_t robust_value) {
    const uint32_t value = parameters.integer(name);
    return value > 0 ? value : is_robust(parameters) ? robust_value : published;
}

Geometry build(const Curves& curves, const BuildOptions& options) {
    const bool flat = options.caps == Caps::flat;
    const bool is_robust_variant = is_robust(options.parameters);
    const uint32_t splits = number_or(options.parameters, "splits", 1, 4);
    // The iteration is safe on pieces that turn at most a quarter; the published algorithm does not split.
    const double most_turn = is_robust_variant ? quarter_turn : std::numeric_limits<double>::infinity();
    const std::vector<uint32_t> pieces = curved_pieces(curves, splits, most_turn, options.leaf_budget);
    Geometry geometry = build_curved(curves, pieces, flat);
    geometry.constants = {{robust, is_robust_variant ? 1u : 0u},
                          {iterations, number_or(options.parameters, "iterations", 8, 24)},
                          {flat_ends, flat ? 1u : 0u}};
    return geometry;
}

std::vector<ParameterInfo> parameters() {
    ParameterInfo splits = splits_parameter(0);
    splits.low = 0;
    splits.help += " (0: 4 robust, 1 published; robust raises it where a piece would turn over 90 degrees)";
    return {{.name = "variant",
             .help = "published: as in the paper; robust: exact frame, pieces, safeguarded steps",
             .default_value = "robust",
             .choices = {"published", "robust"}},
            {.name = "iterations",
             .help = "cones tried from each end of a leaf (0: 24 robust, 8 published)",
             .default_value = "0",
             .low = 0,
             .high = 40,
             .integer = true},
            std::move(splits)};
}

Tolerance tolerance(const BuildOptions& options) {
    if (is_robust(options.parameters)) return {};
    return {.reason = "the published frame rounds to ulps of the distance, and misses burn all iterations",
            .judged = false};
}

}  // namespace

Primitive prhi() {
    return {
        .name = "prhi",
        .summary = "phantom ray-hair intersector: swept discs on the cubic itself, by a few cones",
        .parameters = parameters(),
        .caps = {Caps::open, Caps::flat},
        .surface = surface,
        .build = build,
        .shaders = {.intersection = "prhi.rint", .closest_hit = "curve.rchit", .any_hit = ""},
        .cpu = {.single = intersect<float>, .precise = intersect<double>, .counted = counted},
        .spawn = {.radii = 0.01, .ulps = 16},
        .tolerance = tolerance,
    };
}

}  // namespace strandlab
