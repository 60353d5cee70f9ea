#include "measure/flip.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace strandlab {
namespace {

constexpr double pi = std::numbers::pi;

/// White of the standard illuminant D65, and XYZ of the primaries' linear values, which add up to it.
const glm::dvec3 white(0.950428545, 1.0, 1.088900371);

glm::dvec3 xyz_of(const glm::dvec3& rgb) {
    return {(10135552 * rgb.r + 8788810 * rgb.g + 4435075 * rgb.b) / 24577794,
            (2613072 * rgb.r + 8788810 * rgb.g + 887015 * rgb.b) / 12288897,
            (1425312 * rgb.r + 8788810 * rgb.g + 70074185 * rgb.b) / 73733382};
}

glm::dvec3 rgb_of(const glm::dvec3& xyz) {
    return {3.241003275 * xyz.x - 1.537398934 * xyz.y - 0.498615861 * xyz.z,
            -0.969224334 * xyz.x + 1.875930071 * xyz.y + 0.041554224 * xyz.z,
            0.055639423 * xyz.x - 0.204011202 * xyz.y + 1.057148933 * xyz.z};
}

/// Lightness, red against green, blue against yellow, of values relative to white.
glm::dvec3 opponents_of(const glm::dvec3& relative) {
    return {116 * relative.y - 16, 500 * (relative.x - relative.y), 200 * (relative.y - relative.z)};
}

glm::dvec3 relative_of(const glm::dvec3& opponents) {
    const double y = (opponents.x + 16) / 116;
    return {y + opponents.y / 500, y, y - opponents.z / 200};
}

/// L*a*b* with less colour the darker it is (Hunt effect).
glm::dvec3 perceived(const glm::dvec3& rgb) {
    const auto compressed = [](double value) {
        constexpr double bend = 6.0 / 29;
        return value > bend * bend * bend ? std::cbrt(value) : value / (3 * bend * bend) + 4.0 / 29;
    };
    const glm::dvec3 relative = xyz_of(rgb) / white;
    const glm::dvec3 lab =
        opponents_of({compressed(relative.x), compressed(relative.y), compressed(relative.z)});
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// The HyAB distance of two perceived colours to the power of 0.7.
double colour_distance(const glm::dvec3& a, const glm::dvec3& b) {
    return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
}

/// A distance as an error from 0 to 1, where 0.95 lies at four tenths of the largest distance.
double colour_error(double distance) {
    static const double largest = colour_distance(perceived({0, 1, 0}), perceived({0, 0, 1}));
    const double bend = 0.4 * largest;
    return distance < bend ? 0.95 * distance / bend : 0.95 + 0.05 * (distance - bend) / (largest - bend);
}

using Plane = std::vector<double>;
using Weights = std::vector<double>;  // of the places -radius to radius

/// exp(-x^2 / scale), whose weights add up to 1.
struct Gaussian {
    Weights weights;
    double sum = 0;  // before they were scaled

    Gaussian(int radius, double scale) {
        for (int x = -radius; x <= radius; ++x) weights.push_back(std::exp(-double(x) * x / scale));
        for (const double weight : weights) sum += weight;
        for (double& weight : weights) weight /= sum;
    }
};

/// Weights times factor(x), positive ones adding up to 1 and negative ones to -1.
template <class Factor>
Weights balanced(Weights weights, const Factor& factor) {
    const int radius = static_cast<int>(weights.size()) / 2;
    double positive = 0, negative = 0;
    for (int x = -radius; x <= radius; ++x) {
        double& weight = weights[static_cast<size_t>(x + radius)];
        weight *= factor(x);
        (weight > 0 ? positive : negative) += std::abs(weight);
    }
    for (double& weight : weights) weight /= weight > 0 ? positive : std::max(negative, 1e-300);
    return weights;
}

/// A picture's shape, and filters over its planes; beyond its edge is what lies at it.
struct Grid {
    int width = 0, height = 0;

    /// Weights across rows, then down columns.
    Plane filtered(const Plane& plane, const Weights& across, const Weights& down) const {
        return along<false>(along<true>(plane, across), down);
    }

  private:
    template <bool across>
    Plane along(const Plane& plane, const Weights& weights) const {
        const int radius = static_cast<int>(weights.size()) / 2, last = (across ? width : height) - 1;
        Plane result(plane.size());
        parallel_for(static_cast<size_t>(height), [&](size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < width; ++x) {
                double sum = 0;
                for (int i = -radius; i <= radius; ++i) {
                    const int place = std::clamp((across ? x : y) + i, 0, last);
                    const int pixel = across ? y * width + place : place * width + x;
                    sum += weights[static_cast<size_t>(i + radius)] * plane[static_cast<size_t>(pixel)];
                }
                result[static_cast<size_t>(y * width + x)] = sum;
            }
        });
        return result;
    }
};

/// What an eye takes from a picture: colours as blurred as it sees them, edges and points.
struct Seen {
    std::vector<glm::dvec3> colours;
    Plane edges, points;  // how strong they are
};

/// Contrast sensitivities of the three opponent channels as sums of Gaussians.
class Eye {
  public:
    Eye(const Grid& grid, double pixels_per_degree)
        : grid_(grid),
          radius_(static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree))),
          lightness_(sensitivity(0.0047, pixels_per_degree)),
          red_green_(sensitivity(0.0053, pixels_per_degree)),
          wide_(sensitivity(0.04, pixels_per_degree)),
          narrow_(sensitivity(0.025, pixels_per_degree)) {
        const double deviation = 0.5 * 0.082 * pixels_per_degree;
        const int radius = static_cast<int>(std::ceil(3 * deviation));
        blur_ = Gaussian(radius, 2 * deviation * deviation).weights;
        slope_ = balanced(blur_, [](int x) { return -double(x); });
        bend_ = balanced(blur_, [&](int x) { return double(x) * x / (deviation * deviation) - 1; });
        // Heights of the two Gaussians of blue against yellow, times their sums over the plane.
        const double wide = 34.1 * std::sqrt(pi / 0.04) * wide_.sum * wide_.sum;
        const double narrow = 13.5 * std::sqrt(pi / 0.025) * narrow_.sum * narrow_.sum;
        wide_share_ = wide / (wide + narrow);
    }

    Seen look(std::span<const glm::vec3> picture) const {
        std::array<Plane, 3> channels;
        for (Plane& channel : channels) channel.resize(picture.size());
        parallel_for(picture.size(), [&](size_t i) {
            const glm::dvec3 opponents = opponents_of(xyz_of(clamped(picture[i])) / white);
            for (int c = 0; c < 3; ++c) channels[static_cast<size_t>(c)][i] = opponents[c];
        });
        Seen seen;
        seen.edges = strength(channels[0], slope_);
        seen.points = strength(channels[0], bend_);
        const auto blurred = [&](const Plane& plane, const Gaussian& gaussian) {
            return grid_.filtered(plane, gaussian.weights, gaussian.weights);
        };
        const Plane lightness = blurred(channels[0], lightness_),
                    red_green = blurred(channels[1], red_green_), wide = blurred(channels[2], wide_),
                    narrow = blurred(channels[2], narrow_);
        seen.colours.resize(picture.size());
        parallel_for(picture.size(), [&](size_t i) {
            const double blue_yellow = wide_share_ * wide[i] + (1 - wide_share_) * narrow[i];
            const glm::dvec3 rgb = rgb_of(relative_of({lightness[i], red_green[i], blue_yellow}) * white);
            seen.colours[i] = perceived(glm::clamp(rgb, 0.0, 1.0));
        });
        return seen;
    }

  private:
    Gaussian sensitivity(double b, double pixels_per_degree) const {
        return {radius_, b * pixels_per_degree * pixels_per_degree / (pi * pi)};
    }

    static glm::dvec3 clamped(const glm::vec3& colour) {
        const auto unit = [](float value) { return value > 0 ? std::min(double(value), 1.0) : 0.0; };
        return {unit(colour.r), unit(colour.g), unit(colour.b)};
    }

    /// Length of the derivatives across and down, of the channel from 0 (black) to 1 (white).
    Plane strength(const Plane& lightness, const Weights& derivative) const {
        Plane result = grid_.filtered(lightness, derivative, blur_);
        const Plane down = grid_.filtered(lightness, blur_, derivative);
        for (size_t i = 0; i < result.size(); ++i) result[i] = std::hypot(result[i], down[i]) / 116;
        return result;
    }

    Grid grid_;
    int radius_;
    Gaussian lightness_, red_green_, wide_, narrow_;
    double wide_share_ = 0;
    Weights blur_, slope_, bend_;
};

}  // namespace

std::vector<float> flip(std::span<const glm::vec3> reference, std::span<const glm::vec3> test, uint32_t width,
                        uint32_t height, double pixels_per_degree) {
    assert(reference.size() == size_t(width) * height && test.size() == reference.size());
    const Eye eye({static_cast<int>(width), static_cast<int>(height)}, pixels_per_degree);
    const Seen a = eye.look(reference), b = eye.look(test);
    std::vector<float> result(reference.size());
    parallel_for(result.size(), [&](size_t i) {
        const double colour = colour_error(colour_distance(a.colours[i], b.colours[i]));
        const double feature =
            std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i])) / std::sqrt(2.0);
        result[i] = static_cast<float>(std::pow(colour, 1 - std::sqrt(std::min(feature, 1.0))));
    });
    return result;
}

double mean_flip(std::span<const glm::vec3> reference, std::span<const glm::vec3> test, uint32_t width,
                 uint32_t height, double pixels_per_degree) {
    double sum = 0;
    for (const float value : flip(reference, test, width, height, pixels_per_degree)) sum += double(value);
    return reference.empty() ? 0 : sum / static_cast<double>(reference.size());
}

}  // namespace strandlab
