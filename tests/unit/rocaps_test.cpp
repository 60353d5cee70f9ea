// Roving capsules against brute force, family by family: the figures that each variant must reach.
#include "base/parallel.h"
#include "primitives/primitive.h"
#include "strands/bezier.h"
#include "unit/support/hit_statistics.h"
#include "unit/support/ray_families.h"
#include "unit/support/sampled_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace strandlab::testing {
namespace {

[[maybe_unused]] bool long_tests() { return std::getenv("STRANDLAB_LONG_TESTS") != nullptr; }

/// One strand per pair.
Curves curves_of(const std::vector<RayCurvePair>& pairs) {
    Curves curves;
    for (const RayCurvePair& pair : pairs) {
        curves.strands.push_back({static_cast<uint32_t>(curves.curves.size()), 1});
        curves.curves.push_back(pair.curve);
    }
    return curves;
}

/// The nearest hit over all leaves [first, last).
template <class Real>
bool nearest_hit(const Primitive& primitive, const Geometry& geometry, size_t first, size_t last, const Ray& ray,
                 LeafHit<Real>& best) {
    bool found = false;
    best.t = Real(ray.tmax);
    for (size_t leaf = first; leaf < last; ++leaf) {
        LeafHit<Real> hit;
        bool hits = false;
        if constexpr (std::is_same_v<Real, float>)
            hits = primitive.cpu.single(geometry, leaf, ray, best.t, hit);
        else
            hits = primitive.cpu.precise(geometry, leaf, ray, best.t, hit);
        if (hits) best = hit, found = true;
    }
    return found;
}

/// What brute force says of a pair; a pair is decisive when radii 1e-3 larger and smaller do not change it.
struct Judged {
    SweepHit reference;
    bool decisive = false;
};

Judged judge(const RayCurvePair& pair, bool open) {
    Judged judged{sampled_sweep_hit(pair.curve, pair.ray, 1, open), true};
    const SweepHit& hit = judged.reference;
    const double length = glm::length(glm::dvec3(pair.ray.direction));
    for (const double scale : {1 - 1e-3, 1 + 1e-3}) {
        const SweepHit other = sampled_sweep_hit(pair.curve, pair.ray, scale, open);
        if (other.is_hit() != hit.is_hit() ||
            (hit.is_hit() && !(std::abs(other.t - hit.t) * length < 0.3 * hit.radius)))
            judged.decisive = false;
    }
    // At a tip of radius 0 nothing can be right or wrong.
    if (hit.is_hit() && !(hit.radius > 1e-6 * pair.curve[0].w)) judged.decisive = false;
    if (open && hit.is_hit() && !(hit.u > 1e-3 && hit.u < 1 - 1e-3)) judged.decisive = false;
    return judged;
}

std::vector<Judged> judge_all(const std::vector<RayCurvePair>& pairs, bool open = false) {
    std::vector<Judged> judged(pairs.size());
    parallel_for(pairs.size(), [&](size_t i) { judged[i] = judge(pairs[i], open); });
    return judged;
}

template <class Real>
HitStatistics measure(const std::vector<RayCurvePair>& pairs, const std::vector<Judged>& judged,
                      const std::string& choice_text, const std::string& caps = "round", bool print = false) {
    const PrimitiveChoice choice = parse_primitive(choice_text, caps);
    const Geometry geometry = choice.primitive->build(curves_of(pairs), choice.options);
    const size_t leaves = geometry.leaf_count() / pairs.size();
    std::vector<LeafHit<Real>> hits(pairs.size());
    std::vector<char> found(pairs.size());
    parallel_for(pairs.size(), [&](size_t i) {
        found[i] = nearest_hit(*choice.primitive, geometry, i * leaves, (i + 1) * leaves, pairs[i].ray, hits[i]);
    });
    HitStatistics statistics;
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (!judged[i].decisive) continue;
        const SweepHit& reference = judged[i].reference;
        ++(reference.is_hit() ? statistics.hits : statistics.misses);
        const char* fault = nullptr;
        if (reference.is_hit() && !found[i]) ++statistics.false_misses, fault = "false miss";
        if (!reference.is_hit() && found[i]) ++statistics.false_hits, fault = "false hit";
        if (reference.is_hit() && found[i]) {
            const double length = glm::length(glm::dvec3(pairs[i].ray.direction));
            const double error = std::abs(double(hits[i].t) - reference.t) * length;
            const double ulp = std::abs(reference.t) * length * double(std::numeric_limits<Real>::epsilon());
            if (error > std::max(0.5 * reference.radius, 8 * ulp)) {
                ++statistics.wrong_hits, fault = "wrong hit";
            } else {
                statistics.depth_errors.push_back(error / reference.radius);
                if (print && error > 1e-4 * reference.radius && error > 1e-4) fault = "inexact";
                const glm::dvec3 n(hits[i].normal);
                statistics.normal_errors.push_back(
                    std::atan2(glm::length(glm::cross(n, reference.normal)), glm::dot(n, reference.normal)));
            }
        }
        if (fault && print)
            std::printf("pair %zu: %s, reference t %.9g u %.9g r %.3g inside %d, got t %.9g u %.9g\n", i, fault,
                        reference.t, reference.u, reference.radius, reference.starts_inside, double(hits[i].t),
                        double(hits[i].u));
    }
    return statistics;
}

std::vector<RayCurvePair> pairs_of(const RayFamily& family, size_t count) {
    std::vector<RayCurvePair> pairs(count);
    parallel_for(count, [&](size_t i) { pairs[i] = make_pair(family, i); });
    return pairs;
}

void print(const std::string& name, const std::string& what, HitStatistics& s) {
    std::printf("%-13s %-30s %6zu/%6zu FM %.1e FH %.1e WH %.1e dt/r %.1e %.1e n %.1e %.1e\n", name.c_str(),
                what.c_str(), s.hits, s.misses, s.false_miss_rate(), s.false_hit_rate(), s.wrong_hit_rate(),
                quantile(s.depth_errors, 0.5), quantile(s.depth_errors, 0.99), quantile(s.normal_errors, 0.5),
                quantile(s.normal_errors, 0.99));
    std::fflush(stdout);
}

TEST(Rocaps, Explore) {
    const char* text = std::getenv("COUNT");
    const size_t count = text ? std::strtoul(text, nullptr, 10) : 2000;
    const char* only = std::getenv("FAMILY");
    const char* what = std::getenv("WHAT");
    for (const RayFamily& family : ray_families()) {
        if (only && family.name != only) continue;
        const auto pairs = pairs_of(family, count);
        const auto judged = judge_all(pairs);
        for (const std::string choice : {"rocaps:splits=1", "rocaps", "rocaps:variant=published"}) {
            if (what && choice != what) continue;
            auto single = measure<float>(pairs, judged, choice, "round", only != nullptr);
            print(family.name, choice, single);
            auto precise = measure<double>(pairs, judged, choice);
            print(family.name, choice + " double", precise);
        }
    }
    if (!only || std::string(only) == "structured") {
        const auto pairs = structured_pairs();
        const auto judged = judge_all(pairs);
        for (const std::string choice : {"rocaps:splits=1", "rocaps", "rocaps:variant=published"}) {
            if (what && choice != what) continue;
            auto single = measure<float>(pairs, judged, choice, "round", only != nullptr);
            print("structured", choice, single);
            auto precise = measure<double>(pairs, judged, choice);
            print("structured", choice + " double", precise);
        }
    }
}

}  // namespace
}  // namespace strandlab::testing
