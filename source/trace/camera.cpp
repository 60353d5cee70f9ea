#include "trace/camera.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace strandlab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Tangents of half the field of view, across and up.
struct HalfAngles {
    double across, up;
};

HalfAngles half_angles(double fov, double aspect) {
    const double up = std::tan(fov * (std::numbers::pi / 360));
    return {up * aspect, up};
}

/// How far the eye may be along the inward normals of the four sides of the picture's pyramid, and the
/// depths of the nearest and farthest point. A ball (c, r) is inside when n . (c - eye) >= r for each
/// side; the sides' normals are (-+cos, 0, sin) and (0, -+cos, sin) in (right, up, forward).
struct Fit {
    std::array<double, 4> reach{infinity, infinity, infinity, infinity};  // right, left, top, bottom
    double nearest = infinity, farthest = -infinity;

    void add(const Fit& other) {
        for (size_t i = 0; i < reach.size(); ++i) reach[i] = std::min(reach[i], other.reach[i]);
        nearest = std::min(nearest, other.nearest);
        farthest = std::max(farthest, other.farthest);
    }
};

/// Sine and cosine of half the field of view in one direction.
struct Slope {
    double sine, cosine;
    explicit Slope(double tangent)
        : sine(tangent / std::hypot(1.0, tangent)), cosine(1 / std::hypot(1.0, tangent)) {}
};

void add_ball(Fit& fit, const CameraFrame& frame, const Slope& across, const Slope& up,
              const glm::dvec4& ball) {
    const glm::dvec3 centre(ball);
    const double x = glm::dot(frame.right, centre), y = glm::dot(frame.up, centre);
    const double z = glm::dot(frame.forward, centre), radius = ball.w;
    const std::array<double, 4> reach = {
        across.sine * z - across.cosine * x - radius, across.sine * z + across.cosine * x - radius,
        up.sine * z - up.cosine * y - radius, up.sine * z + up.cosine * y - radius};
    for (size_t i = 0; i < reach.size(); ++i) fit.reach[i] = std::min(fit.reach[i], reach[i]);
    fit.nearest = std::min(fit.nearest, z - radius);
    fit.farthest = std::max(fit.farthest, z + radius);
}

/// The nearest eye from which everything fits: each pair of opposite sides bounds the eye by two lines
/// that cross at the pair's own nearest eye; the farther of the two pairs decides, and the other
/// coordinate stays midway between its sides.
Camera fitted(const Fit& fit, const CameraFrame& frame, const Slope& across, const Slope& up,
              const CameraChoice& choice) {
    const double extent = fit.farthest - fit.nearest;
    const double middle = 0.5 * (fit.nearest + fit.farthest);
    const double x = (fit.reach[1] - fit.reach[0]) / (2 * across.cosine);
    const double y = (fit.reach[3] - fit.reach[2]) / (2 * up.cosine);
    double z = std::min((fit.reach[0] + fit.reach[1]) / (2 * across.sine),
                        (fit.reach[2] + fit.reach[3]) / (2 * up.sine));
    // All balls in one point without a radius: the eye would be there too, up to rounding.
    const double size = std::max(std::abs(fit.nearest), std::abs(fit.farthest));
    if (!(fit.nearest - z > 1e-9 * size)) z = fit.nearest - std::max(extent, size > 0 ? 1e-3 * size : 1.0);
    Camera camera;
    camera.eye = frame.right * x + frame.up * y + frame.forward * z;
    camera.target = camera.eye + frame.forward * (middle - z);
    camera.up = choice.up;
    const double tangent = std::tan(choice.fov * (std::numbers::pi / 360)) / choice.zoom;
    camera.fov = std::atan(tangent) * (360 / std::numbers::pi);
    return camera;
}

/// Frames count balls, ball_at(i) each, in blocks whose results are joined in any order alike.
template <class BallAt>
Camera framing_of(size_t count, const BallAt& ball_at, double aspect, const CameraChoice& choice) {
    if (choice.eye) return {*choice.eye, choice.target.value_or(glm::dvec3(0)), choice.up, choice.fov};
    if (count == 0) fail(ExitCode::bad_input, "--camera: nothing to look at: the model has no curves");
    const CameraFrame frame = frame_of({choice.from, glm::dvec3(0), choice.up, choice.fov});
    const HalfAngles half = half_angles(choice.fov, aspect);
    const double inside = 1 - choice.margin;
    const Slope across(half.across * inside), up(half.up * inside);

    constexpr size_t block_size = 8192;
    std::vector<Fit> blocks((count + block_size - 1) / block_size);
    parallel_for(blocks.size(), [&](size_t block) {
        const size_t end = std::min(count, (block + 1) * block_size);
        for (size_t i = block * block_size; i < end; ++i)
            add_ball(blocks[block], frame, across, up, ball_at(i));
    });
    Fit fit;
    for (const Fit& block : blocks) fit.add(block);
    return fitted(fit, frame, across, up, choice);
}

}  // namespace

CameraFrame frame_of(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    glm::dvec3 side = glm::cross(forward, camera.up);
    if (!(glm::length(side) > 1e-9 * glm::length(camera.up))) {
        const glm::dvec3 size = glm::abs(forward);
        const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        glm::dvec3 other(0);
        other[axis] = 1;
        side = glm::cross(forward, other);
    }
    const glm::dvec3 right = glm::normalize(side);
    return {right, glm::cross(right, forward), forward};
}

glm::dvec3 world_direction(const Camera& camera, const glm::dvec3& in_camera) {
    const CameraFrame frame = frame_of(camera);
    return glm::normalize(frame.right * in_camera.x + frame.up * in_camera.y - frame.forward * in_camera.z);
}

glm::dvec3 light_direction(const Camera& camera) {
    return world_direction(camera, glm::normalize(glm::dvec3(0.5, 0.8, 0.7)));
}

Camera framing(std::span<const glm::vec4> balls, double aspect, const CameraChoice& choice) {
    return framing_of(
        balls.size(), [&](size_t i) { return glm::dvec4(balls[i]); }, aspect, choice);
}

Camera framing(const Curves& curves, double aspect, const CameraChoice& choice) {
    const auto ball_at = [&](size_t i) { return glm::dvec4(curves.curves[i / 4][i % 4]); };
    return framing_of(curves.curves.size() * 4, ball_at, aspect, choice);
}

Camera framing(const Box& bounds, double aspect, const CameraChoice& choice) {
    const auto corner = [&](size_t i) {
        return glm::dvec4(i & 1 ? bounds.high.x : bounds.low.x, i & 2 ? bounds.high.y : bounds.low.y,
                          i & 4 ? bounds.high.z : bounds.low.z, 0);
    };
    return framing_of(bounds.is_empty() ? 0 : 8, corner, aspect, choice);
}

}  // namespace strandlab
