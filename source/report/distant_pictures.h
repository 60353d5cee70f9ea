// What pictures show of a primitive's errors when the hair is farther away.
#pragma once

#include "measure/bench_case.h"
#include "measure/lod_sweep.h"
#include "trace/occluder.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strandlab {

/// Converged pictures of a primitive and of the common reference, made with the same rays, from one distance.
struct DistantError {
    double scale = 1;    // times the camera's distance
    uint64_t rays = 0;   // of the picture
    DetailError detail;  // pixels of the primitive's picture against those of the reference
    /// Mean of (t - reference t) |direction| / radius, over the rays that hit in both; of none: empty.
    std::optional<double> depth_bias;
    double flip = 0;  // mean over the pixels
};

/// The common reference from 1, 2, 4, ... 32 times the camera's distance: about as many rays from each, over
/// fewer and fewer pixels, and shadow rays from what they hit.
class DistantPictures {
  public:
    /// Pixels at distance 1, at most (there are fewer where the picture itself is smaller), and rays in each.
    static constexpr uint32_t pixels = 240 * 135, samples = 8;
    static constexpr double farthest = 32;

    /// width, height: shape of the picture that `camera` is for. Keeps a reference to the input, whose
    /// options say how scenes are put on the device; but for the origins of rays, which lie farther away
    /// here.
    DistantPictures(const CaseInput& input, const Camera& camera, uint32_t width, uint32_t height,
                    uint64_t seed, Caps caps);
    ~DistantPictures();

    /// A primitive's errors, nearest picture first. Throws as TraceDevice::prepare where it does not fit the
    /// device.
    std::vector<DistantError> errors_of(const PrimitiveChoice& choice) const;

  private:
    struct View;

    void fill(View& view, std::span<const Surface> surfaces, const Occluder& body, uint64_t seed) const;
    /// Linear colours.
    std::vector<glm::vec3> picture(const View& view, const Hits& hits) const;

    const CaseInput& input_;
    glm::dvec3 to_light_;
    std::vector<View> views_;
    float extent_ = 0;
};

}  // namespace strandlab
