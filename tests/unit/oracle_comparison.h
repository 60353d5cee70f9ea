// The reference against dense search, its long double version and Embree: one ray at a time, and tallies.
#pragma once

#include "base/parallel.h"
#include "oracle_brute_force.h"
#include "oracle_cases.h"
#include "strands/bezier.h"
#include "trace/embree_reference.h"
#include "trace/oracle.h"
#include "trace/reference.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace strandlab::oracle_cases {

/// What one ray of a comparison came to.
struct Outcome {
    bool decisive = false, hit_here = false, hit_there = false;
    bool at_fold = false;   // then not decisive
    double difference = 0;  // of t, in radii
};

struct Tally {
    size_t rays = 0, hits = 0, decisive = 0, missing = 0, extra = 0, elsewhere = 0, folds = 0;
    double worst = 0;

    void add(const Outcome& o, double elsewhere_from) {
        ++rays;
        hits += o.hit_here;
        folds += o.at_fold;
        if (!o.decisive) return;
        ++decisive;
        missing += o.hit_there && !o.hit_here;
        extra += o.hit_here && !o.hit_there;
        if (!o.hit_here || !o.hit_there) return;
        if (o.difference > elsewhere_from)
            ++elsewhere;
        else
            worst = std::max(worst, o.difference);
    }
    std::string text() const {
        return fmt::format(
            "{} rays, {} hits, {} decisive, {} at folds; missing {}, extra {}, elsewhere {}, |dt|/r <= "
            "{:.1e}",
            rays, hits, decisive, folds, missing, extra, elsewhere, worst);
    }
};

/// compare(curve) gives a function of a ray of that curve; ten rays each. Hits that differ by more than
/// elsewhere_from radii count as hits of another place.
template <class Compare>
Tally compare_all(Family family, size_t curves, const Compare& compare, double elsewhere_from = 1e-3) {
    constexpr size_t rays_per_curve = 10;
    std::vector<Outcome> outcomes(curves * rays_per_curve);
    parallel_for(curves, [&](size_t i) {
        Random random(11, static_cast<uint64_t>(family), i);
        const Curve curve = random_curve(family, random);
        const auto compare_ray = compare(curve);
        for (size_t k = 0; k < rays_per_curve; ++k)
            outcomes[i * rays_per_curve + k] = compare_ray(aimed_ray(curve, random));
    });
    Tally tally;
    for (const Outcome& outcome : outcomes) tally.add(outcome, elsewhere_from);
    return tally;
}

inline double in_radii(const Ray& ray, const ReferenceHit& hit, long double other) {
    return std::abs(static_cast<double>(other - static_cast<long double>(hit.t))) *
           double(glm::length(ray.direction)) / hit.radius;
}

/// Whether the curve all but stands still at u: where it folds back on itself, the swept disc makes half a
/// turn there and sweeps a ball. Whether it does hangs on the last bits of the control points (on an exact
/// line it does not), and the reference stops resolving turns within about 1e-6 of u, so nobody is held to
/// such hits.
inline bool is_fold(const Curve& curve, double u) {
    double length = 0;
    for (int i = 0; i < 3; ++i) length += double(glm::distance(glm::vec3(curve[i]), glm::vec3(curve[i + 1])));
    return glm::length(glm::dvec3(derivative_at(to_double(curve), u))) < 1e-5 * length;
}

inline Outcome against_search(const Curve& curve, const Ray& ray, Surface::Sweep sweep, Caps caps) {
    const Surface surface = surface_of(curve, sweep, caps);
    const Reference reference = make_reference(surface, curves_of(curve), {&ray, 1});
    const brute_force::Search search(curve, ray);
    const brute_force::Result expected =
        sweep == Surface::Sweep::disc ? search.discs() : search.spheres(caps);
    const ReferenceHit& hit = reference.hits[0];
    Outcome outcome{reference.decisive[0] != 0, hit.is_hit(), expected.hit};
    if (sweep == Surface::Sweep::disc)
        outcome.at_fold = (hit.is_hit() && is_fold(curve, hit.u)) ||
                          (expected.hit && is_fold(curve, static_cast<double>(expected.u)));
    if (outcome.at_fold) outcome.decisive = false;
    if (hit.is_hit() && expected.hit) outcome.difference = in_radii(ray, hit, expected.t);
    return outcome;
}

/// Double against long double.
inline Outcome against_long_double(const Oracle& oracle, const Ray& ray) {
    const ReferenceHit hit = oracle.trace(ray);
    const ReferenceHit precise = oracle.trace(ray, OracleOptions{.extended = true});
    Outcome outcome{true, hit.is_hit(), precise.is_hit()};
    if (hit.is_hit() && precise.is_hit()) outcome.difference = in_radii(ray, hit, precise.t);
    return outcome;
}

/// Against Embree's round Bezier curve, which is the open swept disc.
inline Outcome against_embree(const Surface& surface, const Curves& curves, const EmbreeScene& embree,
                              const Ray& ray) {
    const Reference reference = make_reference(surface, curves, {&ray, 1});
    const ReferenceHit& hit = reference.hits[0];
    ReferenceHit expected;
    embree.trace({&ray, 1}, {&expected, 1});
    Outcome outcome{reference.decisive_place[0] != 0 && !hit.starts_inside, hit.is_hit(), expected.is_hit(),
                    0};
    if (hit.is_hit() && expected.is_hit()) outcome.difference = in_radii(ray, hit, expected.t);
    return outcome;
}

}  // namespace strandlab::oracle_cases
