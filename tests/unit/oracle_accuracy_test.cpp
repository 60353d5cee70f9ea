// The reference against dense search, and its double against its long double version.
#include "base/parallel.h"
#include "oracle_brute_force.h"
#include "oracle_cases.h"
#include "strands/bezier.h"
#include "trace/oracle.h"
#include "trace/reference.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace strandlab {
namespace {

using namespace oracle_cases;

/// What one ray of a comparison came to.
struct Outcome {
    bool decisive = false, hit_here = false, hit_there = false;
    double difference = 0;  // of t, in radii
};

struct Tally {
    size_t rays = 0, hits = 0, decisive = 0, missing = 0, extra = 0, elsewhere = 0;
    double worst = 0;

    void add(const Outcome& o, double elsewhere_from) {
        ++rays;
        hits += o.hit_here;
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
            "{} rays, {} hits, {} decisive; missing {}, extra {}, elsewhere {}, |dt|/r <= {:.1e}", rays, hits,
            decisive, missing, extra, elsewhere, worst);
    }
};

template <class Compare>
Tally compare_all(Family family, size_t curves, const Compare& compare, double elsewhere_from = 1e-3) {
    constexpr size_t rays_per_curve = 10;
    std::vector<Outcome> outcomes(curves * rays_per_curve);
    parallel_for(curves, [&](size_t i) {
        Random random(11, static_cast<uint64_t>(family), i);
        const Curve curve = random_curve(family, random);
        for (size_t k = 0; k < rays_per_curve; ++k)
            outcomes[i * rays_per_curve + k] = compare(curve, aimed_ray(curve, random));
    });
    Tally tally;
    for (const Outcome& outcome : outcomes) tally.add(outcome, elsewhere_from);
    return tally;
}

double in_radii(const Ray& ray, const ReferenceHit& hit, long double other) {
    return std::abs(static_cast<double>(other - static_cast<long double>(hit.t))) *
           double(glm::length(ray.direction)) / hit.radius;
}

/// Whether the hit is a point of the disc at its own parameter.
bool lies_on_disc(const Curve& curve, const Ray& ray, const ReferenceHit& hit) {
    const glm::dvec4 centre = point_at(to_double(curve), hit.u);
    const glm::dvec3 off = glm::dvec3(ray.origin) + hit.t * glm::dvec3(ray.direction) - glm::dvec3(centre);
    return std::abs(glm::length(off) - centre.w) <= 1e-5 * centre.w &&
           std::abs(glm::dot(off, tangent_at(to_double(curve), hit.u))) <= 1e-5 * centre.w;
}

Outcome against_search(const Curve& curve, const Ray& ray, Surface::Sweep sweep, Caps caps) {
    const Surface surface = surface_of(curve, sweep, caps);
    const Reference reference = make_reference(surface, curves_of(curve), {&ray, 1});
    const brute_force::Search search(curve, ray);
    const brute_force::Result expected =
        sweep == Surface::Sweep::disc ? search.discs() : search.spheres(caps);
    const ReferenceHit& hit = reference.hits[0];
    Outcome outcome{reference.decisive[0] != 0, hit.is_hit(), expected.hit, 0};
    if (hit.is_hit() && expected.hit) outcome.difference = in_radii(ray, hit, expected.t);
    // At a fold the disc makes half a turn within 1e-7 of u, which no sampling sees: a nearer hit of the
    // oracle counts when it is a point of the surface.
    const bool nearer = hit.is_hit() && (!expected.hit || hit.t < static_cast<double>(expected.t));
    const bool disagrees = !expected.hit || outcome.difference > 1e-3;
    if (sweep == Surface::Sweep::disc && nearer && disagrees && lies_on_disc(curve, ray, hit))
        outcome.decisive = false;
    return outcome;
}

class OracleAccuracy : public testing::TestWithParam<int> {
  protected:
    Family family() const { return static_cast<Family>(GetParam()); }
    /// t is a double: its last bit from 3 units away, in radii, with a factor of ten.
    double floor() const { return family() == Family::thin ? 1e-9 : 1e-11; }
};

TEST_P(OracleAccuracy, SpheresAgreeWithDenseSearch) {
    for (const Caps caps : {Caps::round, Caps::open}) {
        const Tally tally = compare_all(family(), count(40), [&](const Curve& curve, const Ray& ray) {
            return against_search(curve, ray, Surface::Sweep::sphere, caps);
        });
        EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
        EXPECT_GT(tally.hits, tally.rays / 10) << tally.text();
        EXPECT_LT(tally.worst, floor()) << tally.text();
        fmt::print("{} spheres {}: {}\n", name_of(family()), name_of(caps), tally.text());
    }
}

TEST_P(OracleAccuracy, DiscsAgreeWithDenseSearch) {
    const Tally tally = compare_all(family(), count(40), [&](const Curve& curve, const Ray& ray) {
        return against_search(curve, ray, Surface::Sweep::disc, Caps::open);
    });
    EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
    EXPECT_GT(tally.hits, tally.rays / 10) << tally.text();
    EXPECT_LT(tally.worst, floor()) << tally.text();
    fmt::print("{} discs: {}\n", name_of(family()), tally.text());
}

TEST_P(OracleAccuracy, DoubleAgreesWithLongDouble) {
    for (const Surface::Sweep sweep : {Surface::Sweep::sphere, Surface::Sweep::disc}) {
        const Tally tally = compare_all(
            family(), count(100),
            [&](const Curve& curve, const Ray& ray) {
                const Surface surface = surface_of(curve, sweep, Caps::round);
                const Oracle oracle(surface);
                const ReferenceHit hit = oracle.trace(ray);
                const ReferenceHit precise = oracle.trace(ray, OracleOptions{.extended = true});
                Outcome outcome{true, hit.is_hit(), precise.is_hit(), 0};
                if (hit.is_hit() && precise.is_hit()) outcome.difference = in_radii(ray, hit, precise.t);
                EXPECT_EQ(hit.starts_inside, precise.starts_inside);
                return outcome;
            },
            1e-3);
        EXPECT_EQ(tally.missing + tally.extra + tally.elsewhere, 0u) << tally.text();
        EXPECT_LT(tally.worst, floor()) << tally.text();
        fmt::print("{} {} long double: {}\n", name_of(family()),
                   sweep == Surface::Sweep::disc ? "discs" : "spheres", tally.text());
    }
}

INSTANTIATE_TEST_SUITE_P(Families, OracleAccuracy, testing::Range(0, static_cast<int>(Family::count)),
                         [](const auto& tested) {
                             return std::string(name_of(static_cast<Family>(tested.param)));
                         });

}  // namespace
}  // namespace strandlab
