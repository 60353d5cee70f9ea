// Blue noise of the roots.
#include "strands/hair_mesh/root_samples.h"

#include "base/hash.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

/// Smallest distance on the torus among the first n, relative to the largest that n points can keep.
double relative_distance(const std::vector<glm::vec2>& points, size_t n, double area) {
    double least = 1;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 1; j < n; ++j) {
            glm::dvec2 d = glm::dvec2(points[i]) - glm::dvec2(points[j]);
            d -= glm::floor(d + 0.5);
            least = std::min(least, glm::length(d));
        }
    return least / (2 * std::sqrt(area / (2 * std::sqrt(3.0) * double(n))));
}

/// Density of points closer than `width` to the border, relative to the mean.
template <class Border>
double strip_density(const std::vector<glm::vec2>& points, double strip_area, Border&& is_near_border) {
    size_t inside = 0;
    for (const glm::vec2& p : points) inside += is_near_border(p);
    return double(inside) / double(points.size()) / strip_area;
}

TEST(RootSamples, EveryPrefixIsBlueNoise) {
    for (const bool triangle : {false, true}) {
        const auto& points = triangle ? triangle_samples() : square_samples();
        double least = 1;
        for (const size_t n :
             {16, 17, 23, 32, 45, 64, 100, 128, 200, 256, 400, 512, 800, 1024, 1600, 2048, 3000, 4096})
            least = std::min(least, relative_distance(points, n, triangle ? 0.5 : 1));
        fmt::print("{}: smallest distance {:.2f} of the largest possible\n", triangle ? "triangle" : "square",
                   least);
        EXPECT_GE(least, 0.55);
    }
}

TEST(RootSamples, BordersAreAsDenseAsTheRest) {
    constexpr double width = 0.03;
    const double square = strip_density(
        square_samples(), 1 - (1 - 2 * width) * (1 - 2 * width),
        [&](const auto& p) { return p.x < width || p.y < width || p.x > 1 - width || p.y > 1 - width; });
    // Barycentric coordinates below 0.03 cut a triangle (1 - 0.09)^2 times as large.
    const double triangle =
        strip_density(triangle_samples(), 1 - (1 - 3 * width) * (1 - 3 * width),
                      [&](const auto& p) { return p.x < width || p.y < width || p.x + p.y > 1 - width; });
    fmt::print("density in the strip along the border: square {:.3f}, triangle {:.3f}\n", square, triangle);
    EXPECT_NEAR(square, 1, 0.05);
    EXPECT_NEAR(triangle, 1, 0.05);
}

TEST(RootSamples, AreTheSameEverywhere) {
    const auto hash_of = [](const std::vector<glm::vec2>& points) {
        return Hash().add(points.data(), points.size() * sizeof(glm::vec2)).value();
    };
    EXPECT_EQ(hash_of(square_samples()), 0x3c6221170652271fu) << std::hex << hash_of(square_samples());
    EXPECT_EQ(hash_of(triangle_samples()), 0xa1725e4a70bafbc8u) << std::hex << hash_of(triangle_samples());
    EXPECT_EQ(eliminate_samples(100, true, 5), eliminate_samples(100, true, 5));
    EXPECT_NE(eliminate_samples(100, true, 5), eliminate_samples(100, true, 6));
}

TEST(RootSamples, FacesKeepThemInside) {
    for (uint32_t key = 0; key < 24; ++key)
        for (uint32_t index = 0; index < 9000; index += 7) {
            const glm::vec2 q = face_sample(false, key, index), t = face_sample(true, key, index);
            ASSERT_TRUE(q.x >= 0 && q.x <= 1 && q.y >= 0 && q.y <= 1);
            ASSERT_TRUE(t.x >= 0 && t.y >= 0 && t.x + t.y <= 1.0000002f) << t.x << " " << t.y;
        }
    EXPECT_NE(face_sample(false, 0, 3), face_sample(false, 0, 3 + 4096));
}

}  // namespace
}  // namespace strandlab
