// FLIP of pictures whose difference is known, and against its definition written out.
#include "measure/flip.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace strandlab {
namespace {

using Picture = std::vector<glm::vec3>;
constexpr uint32_t width = 24, height = 17;

Picture filled(const glm::vec3& colour) { return Picture(size_t(width) * height, colour); }

Picture noise(uint64_t seed) {
    Random random(seed);
    Picture picture = filled({});
    for (glm::vec3& pixel : picture)
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(random.uniform());
    return picture;
}

TEST(Flip, EqualPicturesDoNotDiffer) {
    const Picture picture = noise(1);
    for (const float value : flip(picture, picture, width, height)) EXPECT_EQ(value, 0);
    EXPECT_EQ(mean_flip({}, {}, 0, 0), 0);
}

TEST(Flip, EvenPicturesDifferByTheirColours) {
    // From L*a*b* of the display's primaries: green (87.73, -86.18, 83.18), blue (32.30, 79.19, -107.86).
    const auto hunt = [](double l, double a) { return 0.01 * l * a; };
    const double largest = std::pow(87.7347 - 32.2970 +
                                        std::hypot(hunt(87.7347, -86.1827) - hunt(32.2970, 79.1875),
                                                   hunt(87.7347, 83.1793) - hunt(32.2970, -107.8602)),
                                    0.7);
    const double black_white = 0.95 + 0.05 * (std::pow(100, 0.7) - 0.4 * largest) / (0.6 * largest);
    EXPECT_NEAR(mean_flip(filled({0, 0, 0}), filled({1, 1, 1}), width, height), black_white, 1e-4);
    EXPECT_NEAR(mean_flip(filled({0, 1, 0}), filled({0, 0, 1}), width, height), 1, 1e-5);
    // Lightness 10 against black: a linear grey of ((10 + 16) / 116)^3.
    const float grey = static_cast<float>(std::pow(26.0 / 116, 3));
    EXPECT_NEAR(mean_flip(filled({0, 0, 0}), filled(glm::vec3(grey)), width, height),
                0.95 * std::pow(10, 0.7) / (0.4 * largest), 1e-4);
}

TEST(Flip, IsSymmetricAndBetweenZeroAndOne) {
    const Picture a = noise(2), b = noise(3);
    const std::vector<float> ab = flip(a, b, width, height);
    EXPECT_EQ(ab, flip(b, a, width, height));
    EXPECT_GT(*std::min_element(ab.begin(), ab.end()), 0);
    EXPECT_LE(*std::max_element(ab.begin(), ab.end()), 1);
}

TEST(Flip, WhatCannotBeSeenCountsLess) {
    // A pattern of single pixels against its even mean: the farther away, the less it is seen.
    Picture pattern = filled({});
    for (size_t i = 0; i < pattern.size(); ++i)
        pattern[i] = glm::vec3((i + i / width) % 2 == 0 ? 0.6f : 0.4f);
    double last = 1;
    for (const double pixels_per_degree : {5.0, 20.0, 67.0}) {
        const double error = mean_flip(filled(glm::vec3(0.5f)), pattern, width, height, pixels_per_degree);
        EXPECT_LT(error, last) << pixels_per_degree;
        last = error;
    }
    EXPECT_LT(last, 0.05);
}

TEST(Flip, ValuesOutsideADisplaysRangeAreClamped) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Picture odd = filled({1, 0, 0});
    odd[5] = {infinity, -infinity, std::nanf("")};
    odd[6] = {7, -1, 0};
    for (const float value : flip(odd, filled({1, 0, 0}), width, height)) EXPECT_EQ(value, 0);
}

/// The features of the definition: a kernel over the plane, its positive weights adding up to 1 and its
/// negative ones to -1.
double feature(const std::vector<double>& luminance, int x, int y, double deviation, bool down,
               const std::function<double(double)>& factor) {
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    double positive = 0, negative = 0, plus = 0, minus = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
            const double weight =
                factor(down ? j : i) * std::exp(-(i * i + j * j) / (2 * deviation * deviation));
            const int column = std::clamp(x + i, 0, int(width) - 1),
                      row = std::clamp(y + j, 0, int(height) - 1);
            const double value = weight * luminance[static_cast<size_t>(row * int(width) + column)];
            (weight > 0 ? positive : negative) += std::abs(weight);
            (weight > 0 ? plus : minus) += value;
        }
    return plus / positive + minus / negative;
}

TEST(Flip, FeaturesAreThoseOfTheDefinition) {
    // Grey pictures close to each other in lightness, so that the colour's part is a plain power: the
    // feature's part is what remains.
    constexpr double pixels_per_degree = 40, deviation = 0.5 * 0.082 * pixels_per_degree;
    const Picture flat = filled(glm::vec3(0.5f));
    Picture bumpy = flat;
    Random random(9);
    for (glm::vec3& pixel : bumpy) pixel = glm::vec3(static_cast<float>(random.range(0.3, 0.7)));
    std::vector<double> luminance;
    for (const glm::vec3& pixel : bumpy) luminance.push_back(double(pixel.x));
    // Blurred luminance by the contrast sensitivity of lightness.
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * 9.869604401089358)) * pixels_per_degree));
    const auto blurred = [&](int x, int y) {
        double sum = 0, weights = 0;
        for (int j = -radius; j <= radius; ++j)
            for (int i = -radius; i <= radius; ++i) {
                const double square = (i * i + j * j) / (pixels_per_degree * pixels_per_degree);
                const double weight = std::exp(-9.869604401089358 * square / 0.0047);
                const int column = std::clamp(x + i, 0, int(width) - 1),
                          row = std::clamp(y + j, 0, int(height) - 1);
                sum += weight * luminance[static_cast<size_t>(row * int(width) + column)];
                weights += weight;
            }
        return sum / weights;
    };
    const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
    const double largest = 41.2760;  // as in EvenPicturesDifferByTheirColours
    const std::vector<float> values = flip(flat, bumpy, width, height, pixels_per_degree);
    for (int y = 0; y < int(height); y += 4)
        for (int x = 0; x < int(width); x += 3) {
            const auto length = [&](const std::function<double(double)>& factor) {
                return std::hypot(feature(luminance, x, y, deviation, false, factor),
                                  feature(luminance, x, y, deviation, true, factor));
            };
            const double edge = length([](double i) { return -i; });
            const double point = length([&](double i) { return i * i / (deviation * deviation) - 1; });
            const double strongest = std::max(edge, point) / std::sqrt(2.0);
            const double distance = std::abs(lightness(blurred(x, y)) - lightness(0.5));
            const double colour = 0.95 * std::pow(distance, 0.7) / (0.4 * largest);
            EXPECT_NEAR(double(values[static_cast<size_t>(y * int(width) + x)]),
                        std::pow(colour, 1 - std::sqrt(strongest)), 1e-3)
                << x << ", " << y;
        }
}

}  // namespace
}  // namespace strandlab
