// A leaf against a ray, in float and in double, with every variant and cap mode of a primitive.
#include "fuzz/intersector_targets.h"

#include "fuzz/ray_and_curves.h"
#include "primitives/dots_kernel.h"
#include "primitives/primitive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab::fuzz {
namespace {

struct Variant {
    const char* text;
    const char* caps;
    /// Share of the box's diagonal by which a hit may leave it: by the overlap of neighbours, or by how far
    /// the barycentrics of a triangle seen edge-on may be off. The published variants promise none.
    double overlap = 2e-4;
};

/// What may be expected of a hit.
struct Expectation {
    /// A valid ray and curves as a reader lets them through, of sizes whose squares and fourth powers neither
    /// over- nor underflow.
    bool ordinary = true;
    bool legal = true;   // the same of any size
    double overlap = 0;  // of Variant; 0: nothing is known
};

template <class Real>
void check_hit(const Ray& ray, const LeafHit<Real>& hit, const Expectation& expect) {
    const auto text = [&] {
        return fmt::format("{} t = {}, u = {}, normal {} {} {}", sizeof(Real) == 4 ? "float" : "double",
                           hit.t, hit.u, hit.normal.x, hit.normal.y, hit.normal.z);
    };
    require(hit.t >= Real(ray.tmin) && hit.t < Real(ray.tmax), "t outside of [tmin, tmax): " + text());
    require(hit.u >= 0 && hit.u <= 1, "u outside of [0, 1]: " + text());
    const Real length = std::sqrt(glm::dot(hit.normal, hit.normal));
    require(!expect.legal || !std::isnan(length), "a normal that is no number: " + text());
    require(!expect.ordinary || std::abs(length - 1) < Real(1e-3), "a normal that is not unit: " + text());
}

/// The box has room for rounding: that of t in the ray's own numbers, and the share of the piece by which
/// neighbours overlap.
template <class Real>
void check_box(const Ray& ray, const LeafHit<Real>& hit, const Box& box, double overlap) {
    const glm::dvec3 step = glm::dvec3(ray.direction) * double(hit.t);
    const glm::dvec3 point = glm::dvec3(ray.origin) + step;
    const glm::dvec3 low(box.low), high(box.high);
    const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(ray.origin)),
                                      glm::max(glm::abs(step), glm::max(glm::abs(low), glm::abs(high))));
    const double slack = 1e-6 * std::max({reach.x, reach.y, reach.z}) + overlap * glm::length(high - low);
    for (int axis = 0; axis < 3; ++axis)
        require(point[axis] >= low[axis] - slack && point[axis] <= high[axis] + slack,
                fmt::format("{}: a hit outside of its box, axis {}: {} not in [{}, {}] +- {}",
                            sizeof(Real) == 4 ? "float" : "double", axis, point[axis], low[axis], high[axis],
                            slack));
}

template <class Real, class Intersect, class Finish>
void check(const Geometry& geometry, size_t leaf, const Ray& ray, Intersect intersect, Finish finish,
           const Expectation& expect) {
    LeafHit<Real> hit;
    if (!intersect(geometry, leaf, ray, Real(ray.tmax), hit)) return;
    check_hit(ray, hit, expect);
    if (expect.overlap > 0) check_box(ray, hit, leaf_boxes(geometry)[leaf], expect.overlap);
    if (!finish) return;
    finish(geometry, leaf, ray, hit);
    require(hit.t >= Real(ray.tmin), "finished in front of tmin");
    require(hit.u >= 0 && hit.u <= 1, "finished with u outside of [0, 1]");
}

void fill(std::byte* bytes, size_t count, InputReader& reader) {
    for (size_t i = 0; i < count; ++i) bytes[i] = reader.take<std::byte>();
}

/// Any bits in all that a shader reads as numbers.
void overwrite_records(Geometry& geometry, InputReader& reader) {
    fill(geometry.leaf_records.bytes.data(), geometry.leaf_records.bytes.size(), reader);
    fill(geometry.curve_records.bytes.data(), geometry.curve_records.bytes.size(), reader);
    for (glm::vec3& vertex : geometry.vertices)
        fill(reinterpret_cast<std::byte*>(&vertex), sizeof vertex, reader);
    if (geometry.shading_records.bytes.empty()) return;
    // The table of joints in front holds indices, which are not the user's.
    const size_t skipped =
        dots_first_joint(geometry, geometry.leaves[0]) * size_t(geometry.shading_records.stride);
    fill(geometry.shading_records.bytes.data() + skipped, geometry.shading_records.bytes.size() - skipped,
         reader);
}

/// Whether every number that is not 0 lies between these sizes.
bool is_within(const RayAndCurves& input, float low, float high) {
    const auto fits = [&](float x) { return x == 0 || (std::abs(x) >= low && std::abs(x) <= high); };
    const auto all_fit = [&](const auto& v, int n) {
        for (int i = 0; i < n; ++i)
            if (!fits(v[i])) return false;
        return true;
    };
    for (const Curve& curve : input.curves.curves)
        for (const glm::vec4& point : curve)
            if (!all_fit(point, 4)) return false;
    return all_fit(input.ray.origin, 3) && all_fit(input.ray.direction, 3);
}

void run(std::span<const Variant> variants, Bytes bytes) {
    InputReader reader(bytes);
    const Variant& variant = variants[reader.below(static_cast<uint32_t>(variants.size()))];
    const bool any_records = reader.below(4) == 3;
    const uint32_t selector = reader.take<uint16_t>();
    const RayAndCurves input = take_ray_and_curves(reader);
    const PrimitiveChoice choice = parse_primitive(variant.text, variant.caps);
    Geometry geometry = choice.primitive->build(input.curves, choice.options);
    if (geometry.leaf_count() == 0) return;
    if (any_records) overwrite_records(geometry, reader);
    Expectation expect;
    expect.legal = !any_records && is_valid(input.ray);
    expect.ordinary = expect.legal && is_within(input, 1e-6f, 1e6f);
    expect.overlap = expect.ordinary ? variant.overlap : 0;
    const size_t leaf = selector % geometry.leaf_count();
    const CpuIntersectors& cpu = choice.primitive->cpu;
    check<float>(geometry, leaf, input.ray, cpu.single, cpu.finish_single, expect);
    check<double>(geometry, leaf, input.ray, cpu.precise, cpu.finish_precise, expect);
}

template <const auto& variants>
void run_variants(Bytes bytes) {
    run(variants, bytes);
}

template <const auto& variants>
std::vector<std::string> seeds() {
    std::vector<std::string> all;
    const std::vector<std::string> inputs = ray_and_curves_seeds();
    for (size_t v = 0; v < std::size(variants); ++v)
        for (size_t i = 0; i < inputs.size(); ++i) {
            const char any_records = i == 0 ? 3 : 0;
            all.push_back(std::string{static_cast<char>(v), any_records, static_cast<char>(i), 0} +
                          inputs[i]);
            if (i == 0) all.push_back(std::string{static_cast<char>(v), 0, 0, 0} + inputs[i]);
        }
    return all;
}

constexpr Variant dots_variants[] = {{"dots", "open", 0.1},
                                     {"dots:segments=1,offset=round", "open", 0.1},
                                     {"dots:normals=flat,segments=3", "open", 0.1}};
constexpr Variant lss_variants[] = {{"lss", "round"}, {"lss:segments=1", "open"}, {"lss:segments=7", "open"}};
constexpr Variant prhi_variants[] = {{"prhi", "open"},
                                     {"prhi:splits=1", "flat"},
                                     {"prhi:variant=published", "open", 0},
                                     {"prhi:variant=published,splits=4", "flat", 0}};
constexpr Variant rocaps_variants[] = {{"rocaps", "round"},
                                       {"rocaps:splits=1,epsilon=0.1", "open"},
                                       {"rocaps:splits=8", "open"},
                                       {"rocaps:variant=published", "round", 0},
                                       {"rocaps:variant=published,splits=4", "open", 0}};

}  // namespace

FuzzTarget dots_target() { return {"dots", run_variants<dots_variants>, seeds<dots_variants>}; }
FuzzTarget lss_target() { return {"lss", run_variants<lss_variants>, seeds<lss_variants>}; }
FuzzTarget prhi_target() { return {"prhi", run_variants<prhi_variants>, seeds<prhi_variants>}; }
FuzzTarget rocaps_target() { return {"rocaps", run_variants<rocaps_variants>, seeds<rocaps_variants>}; }

}  // namespace strandlab::fuzz
