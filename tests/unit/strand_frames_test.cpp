#include "primitives/strand_frames.h"

#include "base/random.h"
#include "unit/support/dots_strips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace strandlab::testing {
namespace {

std::vector<StrandFrame> frames_along(const std::vector<glm::vec4>& points, double roll = 0) {
    std::vector<StrandFrame> frames;
    FrameCarrier carrier(points, roll);
    for (size_t i = 0; i < points.size(); ++i) frames.push_back(carrier.advance());
    return frames;
}

void expect_orthonormal(const StrandFrame& frame) {
    EXPECT_NEAR(glm::length(frame.axis_0), 1, 1e-12);
    EXPECT_NEAR(glm::length(frame.axis_1), 1, 1e-12);
    EXPECT_NEAR(glm::dot(frame.axis_0, frame.axis_1), 0, 1e-12);
}

/// Length and direction of what is left of both end axes across the chord between them.
void expect_untwisted(const glm::vec4& a, const glm::vec4& b, const StrandFrame& start,
                      const StrandFrame& end) {
    const glm::dvec3 chord = glm::normalize(glm::dvec3(b) - glm::dvec3(a));
    const auto across = [&](const glm::dvec3& v) { return v - chord * glm::dot(chord, v); };
    for (const auto& [from, to] :
         {std::pair(start.axis_0, end.axis_0), std::pair(start.axis_1, end.axis_1)}) {
        EXPECT_GE(glm::length(across(from)), 0.5 - 1e-6);
        EXPECT_GE(glm::length(across(to)), 0.5 - 1e-6);
        EXPECT_GT(glm::dot(across(from), across(to)), 0);
    }
}

TEST(StrandFrames, PlaneCurveKeepsItsNormalAxis) {
    std::vector<glm::vec4> points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(std::cos(0.15 * i), std::sin(0.15 * i), 0, 0.01);
    // The frame whose second axis is the plane's normal keeps it; so does every other by its angle to it.
    const std::vector<StrandFrame> frames = frames_along(points, 0.3);
    for (const StrandFrame& frame : frames) {
        expect_orthonormal(frame);
        EXPECT_NEAR(frame.axis_0.z, frames[0].axis_0.z, 1e-12);
        EXPECT_NEAR(frame.axis_1.z, frames[0].axis_1.z, 1e-12);
    }
}

TEST(StrandFrames, HelixTurnsByItsTorsionAgainstTheNormal) {
    // A rotation-minimising frame turns against the Frenet normal by the integral of the torsion.
    const double radius = 1, rise = 0.5, length_per_angle = std::hypot(radius, rise);
    const double torsion = rise / (radius * radius + rise * rise);
    std::vector<glm::vec4> points;
    const int n = 2000;
    const double end = 3 * std::numbers::pi;
    for (int i = 0; i <= n; ++i) {
        const double a = end * i / n;
        points.emplace_back(radius * std::cos(a), radius * std::sin(a), rise * a, 0.01);
    }
    const std::vector<StrandFrame> frames = frames_along(points);
    const auto angle_at = [&](int i) {  // of axis 0 from the normal towards the binormal
        const double a = end * i / n;
        const glm::dvec3 normal(-std::cos(a), -std::sin(a), 0);
        const glm::dvec3 tangent =
            glm::dvec3(-radius * std::sin(a), radius * std::cos(a), rise) / length_per_angle;
        return std::atan2(glm::dot(frames[i].axis_0, glm::cross(tangent, normal)),
                          glm::dot(frames[i].axis_0, normal));
    };
    double turned = angle_at(n - 1) - angle_at(1);
    const double expected = -torsion * length_per_angle * end * (n - 2) / n;
    EXPECT_NEAR(std::remainder(turned - expected, 2 * std::numbers::pi), 0, 1e-4);
}

TEST(StrandFrames, SharpTurnsAndReversalsNeitherTwistNorVanish) {
    for (uint64_t trial = 0; trial < 2000; ++trial) {
        Random random(11, 0, trial);
        std::vector<glm::vec4> points{glm::vec4(0, 0, 0, 1)};
        for (int i = 0; i < 12; ++i) {
            glm::vec4 step(random.signed_unit(), random.signed_unit(), random.signed_unit(), 0);
            // Exact reversals, right angles and zigzags among random turns.
            if (i > 1 && random.below(4) == 0) step = points[points.size() - 2] - points.back();
            if (random.below(4) == 0) step = glm::vec4(i % 2 ? 1 : 0, i % 2 ? 0 : 1, 0, 0);
            points.push_back(points.back() + step);
        }
        const std::vector<StrandFrame> frames = frames_along(points, random.range(0, std::numbers::pi));
        for (size_t i = 0; i < points.size(); ++i) {
            expect_orthonormal(frames[i]);
            if (i > 0) expect_untwisted(points[i - 1], points[i], frames[i - 1], frames[i]);
        }
    }
}

TEST(StrandFrames, RepeatedPointsShareAFrame) {
    const std::vector<glm::vec4> points{{0, 0, 0, 1}, {0, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 2},
                                        {1, 0, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1}};
    const std::vector<StrandFrame> frames = frames_along(points);
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(2, 3), std::pair(3, 4), std::pair(5, 6)}) {
        EXPECT_EQ(frames[a].axis_0, frames[b].axis_0);
        EXPECT_EQ(frames[a].axis_1, frames[b].axis_1);
    }
    expect_untwisted(points[1], points[2], frames[1], frames[2]);
    expect_untwisted(points[4], points[5], frames[4], frames[5]);
    for (const StrandFrame& frame : frames_along({3, glm::vec4(1, 2, 3, 4)})) expect_orthonormal(frame);
}

}  // namespace
}  // namespace strandlab::testing
