// Round cones: the closed form of the reference against its general roots, and the shader text of lss, in
// float and in double, against the reference.
#include "base/parallel.h"
#include "oracle_cases.h"
#include "primitives/primitive.h"
#include "trace/cpu_trace.h"
#include "trace/oracle.h"
#include "trace/reference.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace strandlab {
namespace {

using namespace oracle_cases;

/// A straight piece whose inner control points are exact: multiples of 2^-14, differences of 3 * 2^-14.
Curve exact_line(size_t i) {
    Random random(41, 0, i);
    constexpr float grid = 1.0f / 16384;
    const auto number = [&](double range) {
        return static_cast<float>(std::round(range * random.signed_unit() / grid)) * grid;
    };
    glm::vec4 start(number(1), number(1), number(1), 0), step(number(0.4), number(0.4), number(0.4), 0);
    const uint32_t kind = random.below(4);
    start.w = std::abs(number(kind == 0 ? 0.01 : 0.3)) + grid;
    if (kind == 1) step.w = number(0.1);
    if (kind == 2) step.w = number(0.5);  // steep, often nested
    if (kind == 3) step = glm::vec4(random.below(3) == 0 ? 0.0f : number(0.4), 0, 0, number(0.2));
    if (start.w + 3 * step.w < 0) step.w = 0;
    return {start, start + step, start + 2.0f * step, start + 3.0f * step};
}

TEST(OracleRoundCone, ClosedFormAgreesWithGeneralRoots) {
    const size_t lines = count(4000);
    std::vector<double> worst(lines, 0);
    std::vector<uint8_t> hits(lines, 0);
    parallel_for(lines, [&](size_t i) {
        const Curve line = exact_line(i);
        for (const Caps caps : {Caps::round, Caps::open, Caps::flat})
            for (size_t k = 0; k < 3; ++k) {
                Random random(42, i, k);
                Ray ray = aimed_ray(line, random, k == 2 ? 0.2 : 3);
                if (i % 5 == 0)
                    ray.direction = glm::vec3(k == 0, k == 1, k == 2);  // often parallel or perpendicular
                const Surface curved = surface_of(line, Surface::Sweep::sphere, caps);
                const Surface straight = surface_of(line, Surface::Sweep::sphere, caps, true);
                const Reference reference = make_reference(curved, curves_of(line), {&ray, 1});
                const ReferenceHit &a = reference.hits[0], b = Oracle(straight).trace(ray);
                if (!reference.decisive[0] || !reference.decisive_place[0]) continue;
                ASSERT_EQ(a.is_hit(), b.is_hit())
                    << "line " << i << " ray " << k << " caps " << name_of(caps);
                if (!a.is_hit()) continue;
                hits[i] = 1;
                worst[i] =
                    std::max(worst[i], std::abs(a.t - b.t) * double(glm::length(ray.direction)) / a.radius);
                EXPECT_EQ(a.on_cap, b.on_cap) << "line " << i << " ray " << k << " u " << a.u << ' ' << b.u;
                EXPECT_EQ(a.starts_inside, b.starts_inside) << "line " << i << " ray " << k;
            }
    });
    const double largest = *std::max_element(worst.begin(), worst.end());
    fmt::print("round cones, closed form against general roots: |dt|/r <= {:.1e}\n", largest);
    EXPECT_LT(largest, 1e-8);
    EXPECT_GT(std::count(hits.begin(), hits.end(), 1), static_cast<ptrdiff_t>(lines / 2));
}

/// Classes of errors of one run; never averaged.
struct Classes {
    size_t rays = 0, inside = 0, undecided = 0, hits = 0, false_hits = 0, false_misses = 0, wrong_places = 0;
    double worst = 0;

    void operator+=(const Classes& o) {
        rays += o.rays, inside += o.inside, undecided += o.undecided, hits += o.hits;
        false_hits += o.false_hits, false_misses += o.false_misses, wrong_places += o.wrong_places;
        worst = std::max(worst, o.worst);
    }
    size_t errors() const { return false_hits + false_misses + wrong_places; }
    std::string text() const {
        return fmt::format(
            "{} rays ({} inside, {} undecided), {} hits; false hits {}, false misses {}, wrong places "
            "{}, |dt|/r <= {:.1e}",
            rays, inside, undecided, hits, false_hits, false_misses, wrong_places, worst);
    }
};

/// t_ulp: the unit in the last place of the kernel's t, relative to t.
Classes compare(const Reference& reference, const std::vector<ReferenceHit>& hits,
                const std::vector<Ray>& rays, double t_ulp) {
    Classes classes;
    classes.rays = rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
        const ReferenceHit& expected = reference.hits[i];
        if (expected.starts_inside) {
            ++classes.inside;
        } else if (!reference.decisive[i]) {
            ++classes.undecided;
        } else if (expected.is_hit() != hits[i].is_hit()) {
            ++(expected.is_hit() ? classes.false_misses : classes.false_hits);
        } else if (expected.is_hit()) {
            ++classes.hits;
            const double length = double(glm::length(rays[i].direction));
            const double difference = std::abs(expected.t - hits[i].t);
            const bool elsewhere =
                difference > std::max(0.5 * expected.radius / length, 8 * t_ulp * expected.t);
            if (elsewhere && reference.decisive_place[i]) ++classes.wrong_places;
            if (!elsewhere) classes.worst = std::max(classes.worst, difference * length / expected.radius);
        }
    }
    return classes;
}

std::vector<ReferenceHit> traced_in_float(const Geometry& geometry, const Primitive& primitive,
                                          const std::vector<Ray>& rays) {
    const Hits hits = cpu_trace(geometry, primitive, rays, Precision::single);
    std::vector<ReferenceHit> result(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        result[i].t = double(hits.hits[i].t);
        result[i].curve = hits.hits[i].curve;
    }
    return result;
}

std::vector<Ray> rays_at(const Curve& curve, Random& random, double distance, bool structured) {
    std::vector<Ray> rays;
    for (int k = 0; k < 20; ++k) {
        Ray ray = aimed_ray(curve, random, distance);
        if (structured) {  // along an axis, through points of the curve, often along or across a piece
            const glm::vec4 target = curve[random.below(4)];
            ray.direction = glm::vec3(0);
            ray.direction[static_cast<int>(random.below(3))] = random.below(2) ? 1.0f : -1.0f;
            ray.origin = glm::vec3(target) - float(distance) * ray.direction;
            if (random.below(2)) ray.origin[static_cast<int>(random.below(3))] += 0.5f * target.w;
        }
        rays.push_back(ray);
    }
    return rays;
}

class OracleAgainstLss : public testing::TestWithParam<int> {};

TEST_P(OracleAgainstLss, NoErrorsOnDecisiveRays) {
    const auto family = static_cast<Family>(GetParam());
    for (const std::string_view caps : {"round", "open"})
        for (const double distance : {3.0, 1e4}) {
            const size_t curves = count(60);
            std::vector<Classes> single(curves), precise(curves);
            parallel_for(curves, [&](size_t i) {
                Random random(43, static_cast<uint64_t>(family), i);
                Curve curve = random_curve(family, random);
                if (i % 4 == 0)  // along x
                    for (int k = 0; k < 4; ++k) curve[k] = glm::vec4(0.25f * float(k), 0, 0, curve[k].w);
                const Curves model = curves_of(curve);
                const PrimitiveChoice choice =
                    parse_primitive(i % 2 ? "lss:segments=1" : "lss:segments=8", caps);
                const Surface surface = choice.primitive->surface(model, choice.options);
                const Geometry geometry = choice.primitive->build(model, choice.options);
                const std::vector<Ray> rays = rays_at(curve, random, distance, i % 3 == 0);
                const Reference reference = make_reference(surface, model, rays);
                single[i] =
                    compare(reference, traced_in_float(geometry, *choice.primitive, rays), rays, 1.2e-7);
                precise[i] =
                    compare(reference, cpu_trace_precise(geometry, *choice.primitive, rays), rays, 2.3e-16);
                EXPECT_EQ(single[i].errors() + precise[i].errors(), 0u)
                    << "curve " << i << " at " << distance;
            });
            Classes single_sum, precise_sum;
            for (size_t i = 0; i < curves; ++i) {
                single_sum += single[i];
                precise_sum += precise[i];
            }
            fmt::print("lss {} {} from {}: float {}\n", name_of(family), caps, distance, single_sum.text());
            fmt::print("lss {} {} from {}: double {}\n", name_of(family), caps, distance, precise_sum.text());
            EXPECT_GT(single_sum.hits, single_sum.rays / 10);
            // From 1e4 units the last bit of a double t is 2e-12 units: 2e-7 of the thinnest radius.
            EXPECT_LT(precise_sum.worst, distance > 100 ? 1e-5 : 1e-7);
        }
}

INSTANTIATE_TEST_SUITE_P(Families, OracleAgainstLss, testing::Range(0, static_cast<int>(Family::count)),
                         [](const auto& tested) {
                             return std::string(name_of(static_cast<Family>(tested.param)));
                         });

TEST(CpuTrace, AnyHitAgreesOnWhetherThereIsOne) {
    Random random(44);
    const Curves model = curves_of(random_curve(Family::curl, random));
    const PrimitiveChoice choice = parse_primitive("lss");
    const Geometry geometry = choice.primitive->build(model, choice.options);
    std::vector<Ray> rays;
    for (int i = 0; i < 300; ++i) rays.push_back(aimed_ray(model.curves[0], random));
    rays[7].direction = glm::vec3(0);  // invalid: a miss
    const Hits closest =
        cpu_trace(geometry, *choice.primitive, rays, Precision::single, TraceMode::closest, true);
    const Hits any = cpu_trace(geometry, *choice.primitive, rays, Precision::single, TraceMode::any);
    EXPECT_FALSE(closest.hits[7].is_hit());
    EXPECT_TRUE(any.normals.empty());
    for (size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(closest.hits[i].is_hit(), any.hits[i].is_hit());
        EXPECT_NEAR(glm::length(closest.normals[i]), closest.hits[i].is_hit() ? 1 : 0, 1e-5);
        if (any.hits[i].is_hit()) {
            EXPECT_GE(any.hits[i].t, closest.hits[i].t);
        }
    }
}

}  // namespace
}  // namespace strandlab
