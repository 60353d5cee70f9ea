// How different two pictures look.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace strandlab {

/// Pixels in a degree of the eye's field: 0.7 m before a screen 0.7 m and 3840 pixels wide.
inline constexpr double flip_pixels_per_degree = 3840 * std::numbers::pi / 180;

/// FLIP of each pixel of two pictures that are flipped between, 0 (no difference is seen) to 1: Andersson,
/// Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference Evaluator for Alternating
/// Images" (2020), for pictures of a display's range. Pixels are linear colours (Rec. 709 primaries), rows
/// one after the other; values are clamped to 0 to 1, and NaN counts as 0. Symmetric in the pictures.
/// Parallel; the result does not depend on the number of threads.
std::vector<float> flip(std::span<const glm::vec3> reference, std::span<const glm::vec3> test, uint32_t width,
                        uint32_t height, double pixels_per_degree = flip_pixels_per_degree);

/// The mean over all pixels; 0 for empty pictures.
double mean_flip(std::span<const glm::vec3> reference, std::span<const glm::vec3> test, uint32_t width,
                 uint32_t height, double pixels_per_degree = flip_pixels_per_degree);

}  // namespace strandlab
