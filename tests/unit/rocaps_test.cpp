// Roving capsules against the double-precision oracle, family by family: the figures that each variant must
// reach, and the failures that the published one is known for.
#include "base/parallel.h"
#include "primitives/primitive.h"
#include "strands/bezier.h"
#include "trace/oracle.h"
#include "unit/support/intersector_errors.h"
#include "unit/support/ray_families.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>

namespace strandlab::testing {
namespace {

/// STRANDLAB_LONG_TESTS=N asks for N pairs of every family, and for the table.
size_t pairs_per_family() {
    const char* text = std::getenv("STRANDLAB_LONG_TESTS");
    return text == nullptr ? 1000 : std::max(1000, std::atoi(text));
}

/// A pair, the oracle's answer, and whether that survives radii 1e-3 larger and smaller (and open ends moved
/// by as much). Only decisive answers are fair to ask of a method in single precision.
struct Answered {
    RayCurvePair pair;
    ReferenceHit hit;
    bool decisive = false;
};

Curves one_strand(std::vector<Curve> curves) {
    const auto count = static_cast<uint32_t>(curves.size());
    return {std::move(curves), {{0, count}}};
}

Answered answer(const RayCurvePair& pair, const Curves& strand, const std::string& caps) {
    const PrimitiveChoice choice = parse_primitive("rocaps", caps);
    const Surface surface = choice.primitive->surface(strand, choice.options);
    const Oracle oracle(surface, {.radius_scale = 1 + 1e-3, .end_shift = 1e-3});
    Answered answered{pair, oracle.trace(pair.ray, {}), true};
    const double length = glm::length(glm::dvec3(pair.ray.direction));
    for (const double change : {-1e-3, 1e-3}) {
        const ReferenceHit other = oracle.trace(pair.ray, {.radius_scale = 1 + change, .end_shift = change});
        if (other.is_hit() != answered.hit.is_hit() ||
            (other.is_hit() && !(std::abs(other.t - answered.hit.t) * length < 0.3 * answered.hit.radius)))
            answered.decisive = false;
    }
    // Where the radius vanishes nothing can be right or wrong.
    if (answered.hit.is_hit() && !(answered.hit.radius > 1e-6 * pair.curve[0].w)) answered.decisive = false;
    return answered;
}

std::vector<RayCurvePair> pairs_of(const std::string& name) {
    if (name == "structured") return structured_pairs();
    std::vector<RayCurvePair> pairs(pairs_per_family());
    parallel_for(pairs.size(), [&](size_t i) { pairs[i] = make_pair(ray_family(name), i); });
    return pairs;
}

const std::vector<Answered>& answered_family(const std::string& name, const std::string& caps = "round") {
    static std::map<std::string, std::vector<Answered>> cache;
    std::vector<Answered>& all = cache[name + "/" + caps];
    if (all.empty()) {
        const std::vector<RayCurvePair> pairs = pairs_of(name);
        all.resize(pairs.size());
        parallel_for(all.size(), [&](size_t i) { all[i] = answer(pairs[i], one_strand({pairs[i].curve}), caps); });
    }
    return all;
}

template <class Real>
bool nearest(const PrimitiveChoice& choice, const Curves& strand, const Ray& ray, LeafHit<Real>& best) {
    const Geometry geometry = choice.primitive->build(strand, choice.options);
    bool found = false;
    Real tmax = Real(ray.tmax);
    for (size_t leaf = 0; leaf < geometry.leaf_count(); ++leaf) {
        LeafHit<Real> hit;
        bool hits;
        if constexpr (std::is_same_v<Real, float>)
            hits = choice.primitive->cpu.single(geometry, leaf, ray, tmax, hit);
        else
            hits = choice.primitive->cpu.precise(geometry, leaf, ray, tmax, hit);
        if (!hits) continue;
        found = true;
        tmax = hit.t;
        best = hit;
    }
    return found;
}

void count(const Answered& answered, bool found, double t, const glm::dvec3& normal, IntersectorErrors& errors) {
    if (!answered.decisive) return;
    const ReferenceHit& reference = answered.hit;
    ++(reference.is_hit() ? errors.hits : errors.misses);
    if (!found) {
        errors.false_misses += reference.is_hit();
    } else if (!reference.is_hit()) {
        ++errors.false_hits;
    } else {
        const double angle = std::atan2(glm::length(glm::cross(normal, reference.normal)),
                                        glm::dot(normal, reference.normal));
        errors.add_hit(t, reference.t, glm::length(glm::dvec3(answered.pair.ray.direction)), reference.radius, angle);
    }
}

/// The errors over pairs whose strands make_strand makes of their curve.
template <class Real, class MakeStrand>
IntersectorErrors errors_over(const std::string& label, const std::string& caps, const std::vector<Answered>& all,
                              MakeStrand&& make_strand) {
    const PrimitiveChoice choice = parse_primitive(label, caps);
    std::vector<LeafHit<Real>> hits(all.size());
    std::vector<char> found(all.size());
    parallel_for(all.size(), [&](size_t i) {
        found[i] = nearest(choice, make_strand(all[i].pair.curve), all[i].pair.ray, hits[i]);
    });
    IntersectorErrors errors;
    for (size_t i = 0; i < all.size(); ++i) {
        const size_t faults = errors.false_misses + errors.false_hits + errors.wrong_hits;
        count(all[i], found[i], double(hits[i].t), glm::dvec3(hits[i].normal), errors);
        if (std::getenv("ROCAPS_FAULTS") && errors.false_misses + errors.false_hits + errors.wrong_hits != faults)
            fmt::print("fault {} found {} t {} u {} reference t {} u {} r {} inside {}\n", i, int(found[i]), hits[i].t,
                       hits[i].u, all[i].hit.t, all[i].hit.u, all[i].hit.radius, all[i].hit.starts_inside);
    }
    return errors;
}

template <class Real>
IntersectorErrors errors_of(const std::string& label, const std::string& family, const std::string& caps = "round") {
    return errors_over<Real>(label, caps, answered_family(family, caps),
                             [](const Curve& curve) { return one_strand({curve}); });
}

TEST(Rocaps, Table) {
    if (std::getenv("STRANDLAB_LONG_TESTS") == nullptr) GTEST_SKIP() << "set STRANDLAB_LONG_TESTS to print it";
    for (const std::string label : {"rocaps", "rocaps:splits=1", "rocaps:epsilon=0.1", "rocaps:variant=published"}) {
        fmt::print("\n{}\n{}", label, IntersectorErrors::header());
        for (const RayFamily& f : ray_families()) fmt::print("{}", errors_of<float>(label, f.name).row(f.name));
        fmt::print("{}", errors_of<float>(label, "structured").row("structured"));
    }
    for (const std::string label : {"rocaps", "rocaps:variant=published"}) {
        fmt::print("\n{} in double\n{}", label, IntersectorErrors::header());
        for (const RayFamily& f : ray_families()) fmt::print("{}", errors_of<double>(label, f.name).row(f.name));
        fmt::print("{}", errors_of<double>(label, "structured").row("structured"));
    }
    fmt::print("\nrocaps, open\n{}", IntersectorErrors::header());
    for (const RayFamily& f : ray_families()) fmt::print("{}", errors_of<float>("rocaps", f.name, "open").row(f.name));
    fmt::print("{}", errors_of<float>("rocaps", "structured", "open").row("structured"));
}

TEST(Rocaps, Probe) {
    const std::string label = std::getenv("LABEL"), family = std::getenv("FAMILY"), caps = std::getenv("CAPS");
    fmt::print("{}", errors_of<float>(label, family, caps).row(family));
}

}  // namespace
}  // namespace strandlab::testing
