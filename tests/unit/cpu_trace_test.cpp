// The C++ tracer against what its parts say: the nearest hit is the finished one.
#include "trace/cpu_trace.h"

#include "oracle_cases.h"
#include "primitives/primitive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace strandlab {
namespace {

using namespace oracle_cases;

/// The nearest hit over all leaves by a plain loop, before and after it is finished.
template <class Real, class Intersect, class Finish>
bool nearest(const Geometry& geometry, Intersect intersect, Finish finish, const Ray& ray, LeafHit<Real>& raw,
             LeafHit<Real>& finished) {
    size_t leaf = geometry.leaf_count();
    raw.t = std::numeric_limits<Real>::infinity();
    for (size_t i = 0; i < geometry.leaf_count(); ++i) {
        LeafHit<Real> hit;
        if (!intersect(geometry, i, ray, std::min(raw.t, Real(ray.tmax)), hit)) continue;
        raw = hit;
        leaf = i;
    }
    finished = raw;
    if (leaf == geometry.leaf_count()) return false;
    if (finish) finish(geometry, leaf, ray, finished);
    return true;
}

/// Traces with rounded and with flat offsets; returns how many hits finishing has moved.
size_t check_finished(const char* name) {
    Random random(51);
    const Curves model = curves_of(random_curve(Family::curl, random));
    const PrimitiveChoice choice = parse_primitive(name);
    const Geometry geometry = choice.primitive->build(model, choice.options);
    const CpuIntersectors& cpu = choice.primitive->cpu;
    const CpuTracer single(geometry, *choice.primitive, Precision::single, 5);
    const CpuTracer precise(geometry, *choice.primitive, Precision::precise, 5);
    size_t hits = 0, moved = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = aimed_ray(model.curves[0], random);
        LeafHit<float> raw, expected;
        const bool has_hit = nearest(geometry, cpu.single, cpu.finish_single, ray, raw, expected);
        glm::vec3 normal;
        const Hit hit = single.trace(ray, TraceMode::closest, &normal);
        EXPECT_EQ(hit.is_hit(), has_hit);
        if (has_hit && hit.is_hit()) {
            EXPECT_EQ(hit.t, expected.t);
            EXPECT_EQ(hit.u, expected.u);
            EXPECT_EQ(normal, expected.normal);
            ++hits;
            moved += raw.t != expected.t;
        }
        LeafHit<double> precise_raw, precise_expected;
        const bool precise_has =
            nearest(geometry, cpu.precise, cpu.finish_precise, ray, precise_raw, precise_expected);
        const ReferenceHit unrounded = precise.trace_unrounded(ray);
        EXPECT_EQ(unrounded.is_hit(), precise_has);
        if (precise_has) {
            EXPECT_EQ(unrounded.t, precise_expected.t);
        }
    }
    EXPECT_GT(hits, 500u);
    return moved;
}

TEST(CpuTrace, FinishesTheNearestHit) {
    EXPECT_GT(check_finished("dots:offset=round"), 400u);
    EXPECT_EQ(check_finished("lss"), 0u);
}

}  // namespace
}  // namespace strandlab
