// The mathematics of make_curves.
#include "base/random.h"
#include "strands/bezier.h"
#include "strands/strands.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

Strands strand_of(std::vector<glm::vec4> points) {
    Strands strands;
    strands.first_point.push_back(static_cast<uint32_t>(points.size()));
    strands.points = std::move(points);
    return strands;
}

CurveOptions with_basis(Basis basis) {
    CurveOptions options;
    options.basis = basis;
    return options;
}

Curves convert(const Strands& strands, Basis basis) {
    ImportReport report;
    return make_curves(strands, with_basis(basis), report);
}

/// An uneven strand: steps from 0.05 to 1.
Strands random_strand(uint64_t seed, int n) {
    Random random(seed);
    std::vector<glm::vec4> points;
    glm::dvec3 p(random.signed_unit(), random.signed_unit(), random.signed_unit());
    for (int i = 0; i < n; ++i) {
        points.push_back(glm::vec4(glm::dvec4(p, random.range(0.02, 0.03))));
        const double step = random.range(0.05, 1);
        p += step * glm::normalize(glm::dvec3(1, 0.8 * random.signed_unit(), 0.8 * random.signed_unit()));
    }
    return strand_of(points);
}

/// Barry and Goldman's recursion (1988) for the Catmull-Rom curve through p with these knots.
glm::dvec4 barry_goldman(const glm::dvec4* p, const double* t, double x) {
    const auto mix = [&](const glm::dvec4& a, const glm::dvec4& b, double ta, double tb) {
        return ((tb - x) * a + (x - ta) * b) / (tb - ta);
    };
    const glm::dvec4 a1 = mix(p[0], p[1], t[0], t[1]), a2 = mix(p[1], p[2], t[1], t[2]),
                     a3 = mix(p[2], p[3], t[2], t[3]);
    return mix(mix(a1, a2, t[0], t[2]), mix(a2, a3, t[1], t[3]), t[1], t[2]);
}

TEST(MakeCurves, CatmullRomAgreesWithBarryAndGoldman) {
    for (const Basis basis : {Basis::centripetal, Basis::uniform}) {
        const Strands strands = random_strand(3, 12);
        const Curves curves = convert(strands, basis);
        ASSERT_EQ(curves.curves.size(), 11u);
        std::vector<glm::dvec4> p(strands.points.begin(), strands.points.end());
        p.insert(p.begin(), 2.0 * p[0] - p[1]);
        p.push_back(2.0 * p[p.size() - 1] - p[p.size() - 2]);
        for (size_t c = 0; c < curves.curves.size(); ++c) {
            double t[4] = {0};
            for (int i = 0; i < 3; ++i)
                t[i + 1] = t[i] + (basis == Basis::uniform
                                       ? 1
                                       : std::sqrt(glm::length(glm::dvec3(p[c + i + 1] - p[c + i]))));
            for (const double u : {0.1, 0.37, 0.5, 0.82}) {
                const glm::dvec4 expected = barry_goldman(&p[c], t, t[1] + u * (t[2] - t[1]));
                const glm::dvec4 actual = point_at(to_double(curves.curves[c]), u);
                EXPECT_LT(glm::length(expected - actual), 2e-6) << c << " " << u;
            }
        }
    }
}

TEST(MakeCurves, InterpolatesAndSharesEndPointsBitForBit) {
    for (const Basis basis : {Basis::centripetal, Basis::uniform, Basis::linear}) {
        const Strands strands = random_strand(5, 9);
        const Curves curves = convert(strands, basis);
        for (size_t c = 0; c < curves.curves.size(); ++c) {
            EXPECT_EQ(curves.curves[c][0], strands.points[c]);
            EXPECT_EQ(curves.curves[c][3], strands.points[c + 1]);
        }
    }
    const Curves curves = convert(random_strand(6, 9), Basis::bspline);
    for (size_t c = 1; c < curves.curves.size(); ++c) EXPECT_EQ(curves.curves[c - 1][3], curves.curves[c][0]);
}

TEST(MakeCurves, JoinsSmoothly) {
    for (const Basis basis : {Basis::centripetal, Basis::uniform, Basis::bspline}) {
        const Curves curves = convert(random_strand(7, 20), basis);
        for (size_t c = 1; c < curves.curves.size(); ++c) {
            const glm::dvec4 before = derivative_at(to_double(curves.curves[c - 1]), 1);
            const glm::dvec4 after = derivative_at(to_double(curves.curves[c]), 0);
            EXPECT_GT(glm::dot(glm::normalize(glm::dvec3(before)), glm::normalize(glm::dvec3(after))),
                      1 - 1e-9);
            if (basis != Basis::centripetal) {
                EXPECT_LT(glm::length(before - after), 1e-5);
            }
        }
    }
}

TEST(MakeCurves, BsplineIsC2AndStartsAndEndsAtTheEndPoints) {
    const Strands strands = random_strand(8, 10);
    const Curves curves = convert(strands, Basis::bspline);
    ASSERT_EQ(curves.curves.size(), 9u);
    EXPECT_LT(glm::length(glm::dvec3(curves.curves.front()[0] - strands.points.front())), 1e-6);
    EXPECT_LT(glm::length(glm::dvec3(curves.curves.back()[3] - strands.points.back())), 1e-6);
    for (size_t c = 1; c < curves.curves.size(); ++c)
        EXPECT_LT(glm::length(second_derivative_at(to_double(curves.curves[c - 1]), 1) -
                              second_derivative_at(to_double(curves.curves[c]), 0)),
                  1e-5);
}

TEST(MakeCurves, ReversedStrandsGiveReversedCurves) {
    for (const Basis basis : {Basis::centripetal, Basis::uniform, Basis::linear, Basis::bspline}) {
        const Strands forwards = random_strand(9, 7);
        Strands backwards = forwards;
        std::reverse(backwards.points.begin(), backwards.points.end());
        const Curves a = convert(forwards, basis), b = convert(backwards, basis);
        for (size_t c = 0; c < a.curves.size(); ++c)
            for (int i = 0; i < 4; ++i)
                EXPECT_LT(glm::length(a.curves[c][i] - b.curves[a.curves.size() - 1 - c][3 - i]), 1e-6f);
    }
}

TEST(MakeCurves, CentripetalHasNoLoopsWhereUniformHas) {
    // A short step between two long ones in the other direction: uniform knots overshoot and turn back.
    const Strands strands =
        strand_of({{0, 0, 0, 0.01f}, {1, 0, 0, 0.01f}, {1.01f, 0.01f, 0, 0.01f}, {2, 1, 0, 0.01f}});
    const auto goes_back = [](const Curve& curve) {
        const glm::dvec3 chord(curve[3] - curve[0]);
        for (int i = 0; i <= 100; ++i)
            if (glm::dot(glm::dvec3(derivative_at(to_double(curve), i / 100.0)), chord) < 0) return true;
        return false;
    };
    EXPECT_TRUE(goes_back(convert(strands, Basis::uniform).curves[1]));
    EXPECT_FALSE(goes_back(convert(strands, Basis::centripetal).curves[1]));
}

TEST(MakeCurves, TwoPointsGiveAnEvenLine) {
    for (const Basis basis : {Basis::centripetal, Basis::uniform, Basis::linear, Basis::bspline}) {
        const Curves curves = convert(strand_of({{0, 0, 0, 0.3f}, {3, 6, -9, 0}}), basis);
        ASSERT_EQ(curves.curves.size(), 1u);
        const Curve expected{glm::vec4(0, 0, 0, 0.3f), glm::vec4(1, 2, -3, 0.2f), glm::vec4(2, 4, -6, 0.1f),
                             glm::vec4(3, 6, -9, 0)};
        for (int i = 0; i < 4; ++i) EXPECT_LT(glm::length(curves.curves[0][i] - expected[i]), 1e-6f);
    }
}

TEST(MakeCurves, DropsRepeatedPointsAndShortStrands) {
    Strands strands =
        strand_of({{0, 0, 0, 1}, {0, 0, 0, 5}, {1, 0, 0, 1}, {1, 0, 0, 2}, {1, 0, 0, 3}, {2, 1, 0, 1}});
    strands.points.insert(strands.points.end(), {{7, 7, 7, 1}, {8, 8, 8, 1}, {8, 8, 8, 1}});
    strands.first_point = {0, 6, 6, 7, 9};  // then an empty strand, one of one point, one of a point twice
    ImportReport report;
    const Curves curves = make_curves(strands, {}, report);
    EXPECT_EQ(curves.curves.size(), 2u);
    ASSERT_EQ(curves.strands.size(), 1u);
    EXPECT_EQ(curves.strands[0].count, 2u);
    EXPECT_EQ(report.short_strands, 3u);
    EXPECT_EQ(report.repeated_points, 4u);
    EXPECT_EQ(warnings(report, {}).size(), 2u);
    const Curves same = convert(strand_of({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 1, 0, 1}}), Basis::centripetal);
    EXPECT_EQ(curves.curves, same.curves);
}

TEST(MakeCurves, FillsRadiiFromRootToTipByIndex) {
    CurveOptions options = with_basis(Basis::linear);
    options.root_radius = 4;
    options.tip_radius = 1;
    ImportReport report;
    const Strands strands = strand_of({{0, 0, 0, -1}, {5, 0, 0, -1}, {6, 0, 0, -1}, {7, 0, 0, -1}});
    Curves curves = make_curves(strands, options, report);
    EXPECT_TRUE(report.radii_from_options);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(curves.curves[c][0].w, 4.0f - float(c));
        EXPECT_EQ(curves.curves[c][3].w, 3.0f - float(c));
    }
    options.override_radii = true;
    ImportReport second;
    curves = make_curves(strand_of({{0, 0, 0, 9}, {1, 0, 0, 9}}), options, second);
    EXPECT_EQ(curves.curves[0][0].w, 4.0f);
    EXPECT_FALSE(second.radii_from_options);
}

TEST(MakeCurves, KeepsRadiiWithinBounds) {
    // Points at wildly uneven distances with radii that jump.
    const Curves curves =
        convert(strand_of({{0, 0, 0, 0}, {1e-6f, 0, 0, 1}, {5, 0, 0, 0}, {5, 1e-7f, 0, 1}, {9, 1, 0, 0}}),
                Basis::centripetal);
    for (const Curve& curve : curves.curves)
        for (const glm::vec4& p : curve) EXPECT_TRUE(p.w >= 0 && p.w <= 2);
}

TEST(MakeCurves, ScalesPositionsAndRadii) {
    CurveOptions options = with_basis(Basis::linear);
    options.unit_scale = 0.01f;
    ImportReport report;
    const Curves curves = make_curves(strand_of({{100, 0, 0, 5}, {200, 0, 0, -1}}), options, report);
    EXPECT_FLOAT_EQ(curves.curves[0][0].x, 1);
    EXPECT_FLOAT_EQ(curves.curves[0][0].w, 0.05f);
    EXPECT_FLOAT_EQ(curves.curves[0][3].w, 10e-6f);
}

TEST(MakeCurves, RefusesUnusableNumbersAndOptions) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity, 1e30f}) {
        Strands strands = strand_of({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}, {3, bad, 0, 1}});
        strands.first_point = {0, 2, 4};
        EXPECT_MESSAGE(convert(strands, Basis::linear), "point 1 of strand 1 is (3, ");
    }
    EXPECT_MESSAGE(convert(strand_of({{0, 0, 0, nan}, {1, 0, 0, 1}}), Basis::linear), "with radius nan");
    const auto refused = [](CurveOptions options) {
        ImportReport report;
        return testing_tools::message_of([&] { make_curves(Strands(), options, report); }, ExitCode::usage);
    };
    CurveOptions options;
    options.unit_scale = 0;
    EXPECT_NE(refused(options).find("unit scale 0"), std::string::npos);
    options = {};
    options.tip_radius = nan;
    EXPECT_NE(refused(options).find("radius nan"), std::string::npos);
    options = {};
    options.root_radius = -1;
    EXPECT_NE(refused(options).find("radius -1"), std::string::npos);
    EXPECT_TRUE(convert(Strands(), Basis::centripetal).curves.empty());
}

}  // namespace
}  // namespace strandlab
