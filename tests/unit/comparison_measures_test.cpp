// What is measured of rays that hit the right place.
#include "unit/support/comparison_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace strandlab::testing {
namespace {

TEST(ComparisonMeasures, UContinuesAcrossAJoint) {
    Case c;
    const size_t ray = c.add();
    c.rays[ray].origin.x = 1;
    c.reference[ray].u = 0.999;
    c.hits[ray].curve = 1;
    c.hits[ray].u = 0.002f;
    EXPECT_EQ(c.outcome(), Outcome::match);
    EXPECT_NEAR(c.error(Measure::strand_u), 0.003, 1e-7);
    EXPECT_NEAR(c.error(Measure::offset), 0, 1e-6);
    EXPECT_NEAR(c.error(Measure::tangent), 0, 1e-5);
}

TEST(ComparisonMeasures, OffsetAndTangentFollowTheCurveAtU) {
    Case c;
    // The end of curve 0 leans sideways: at u = 1 the centre is half a radius off and the tangent 45 degrees.
    c.curves.curves[0] = {glm::vec4(0, 0, 0, radius), glm::vec4(0.4f, 0, 0, radius),
                          glm::vec4(1 - radius, -radius / 2, 0, radius), glm::vec4(1, radius / 2, 0, radius)};
    const size_t ray = c.add();
    c.reference[ray].u = 0;
    c.hits[ray].u = 1;
    c.rays[ray].origin = {0, 0, 1};
    EXPECT_NEAR(c.error(Measure::tangent), 45, 1e-3);
    // The line along the tangent at u = 1 passes (0, 0) at the distance |0.5 r - 1| / sqrt(2).
    EXPECT_NEAR(c.error(Measure::offset), (1 - 0.005) / std::sqrt(2.0) / 0.01, 1e-2);
}

TEST(ComparisonMeasures, RaysAlongTheCurveHaveNoOffset) {
    Case c;
    const size_t ray = c.add();
    c.rays[ray].direction = {1, 0, 0};
    EXPECT_TRUE(std::isnan(c.error(Measure::offset)));
    EXPECT_EQ(c.result().decisive.of(Measure::offset).count, 0u);
    EXPECT_EQ(c.result().decisive.of(Measure::strand_u).count, 1u);
}

TEST(ComparisonMeasures, InstancesAreComparedInObjectSpace) {
    Case c;
    const size_t ray = c.add();
    // The instance is the model turned to lie along y, doubled and moved by (3, 0, 0).
    glm::mat4x3 transform(0.0f);
    transform[0] = {0, 2, 0};
    transform[1] = {-2, 0, 0};
    transform[2] = {0, 0, 2};
    transform[3] = {3, 0, 0};
    const std::vector<glm::mat4x3> transforms{glm::mat4x3(1.0f), transform};
    c.rays[ray].origin = {3 + radius, 1, 2};  // u = 0.5, half a radius aside
    c.hits[ray].instance = c.reference[ray].instance = 1;
    const double t = 2 - 2 * static_cast<double>(radius) * std::sqrt(0.75);
    c.reference[ray].t = t;
    c.reference[ray].radius = 2 * static_cast<double>(radius);
    c.hits[ray].t = static_cast<float>(t);
    ComparisonInput in = c.input();
    in.world_from_object = transforms;
    in.residual_of_curves = true;
    const RayError error = RayErrors(in).of(ray);
    EXPECT_EQ(error.outcome, Outcome::match);
    EXPECT_LT(error.measures[static_cast<size_t>(Measure::residual)], 1e-5f);
    EXPECT_EQ(error.measures[static_cast<size_t>(Measure::offset)], 0);
}

TEST(ComparisonMeasures, ResidualOfTheCurvesOrOfTheCaller) {
    Case c;
    const size_t ray = c.add();
    c.hits[ray].t = 1 - 1.25f * radius;
    ComparisonInput in = c.input();
    in.residual_of_curves = true;
    EXPECT_NEAR(compare(in).decisive.of(Measure::residual).max, 0.25, 1e-4);
    in.residual = [](size_t i) { return static_cast<double>(i) + 0.5; };
    EXPECT_EQ(compare(in).decisive.of(Measure::residual).max, 0.5);
}

}  // namespace
}  // namespace strandlab::testing
