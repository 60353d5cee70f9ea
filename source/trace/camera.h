// Pinhole cameras, and how one is placed so that all of the hair is in the picture.
#pragma once

#include "scene/bounds.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace strandlab {

/// A pinhole camera in scene units. Pixels are square; fov is the full vertical field of view in
/// degrees, in (0, 180).
struct Camera {
    glm::dvec3 eye{0, 0, 1};
    glm::dvec3 target{0, 0, 0};
    glm::dvec3 up{0, 1, 0};
    double fov = 30;
};

/// Orthonormal axes of a camera; forward points from the eye to the target, right x up = -forward.
struct CameraFrame {
    glm::dvec3 right, up, forward;
};

/// Axes of a camera. Where up is parallel to the view, the coordinate axis farthest from the view takes
/// its place.
CameraFrame frame_of(const Camera& camera);

/// A direction given in camera axes (right, up, towards the eye), in world space and of unit length:
/// lights are set relative to the picture.
glm::dvec3 world_direction(const Camera& camera, const glm::dvec3& in_camera);

/// The direction to the light of pictures and shadow rays, which stands over the camera's right shoulder.
glm::dvec3 light_direction(const Camera& camera);

/// What a user asks of the camera: either an eye and a target, or a direction to look from whose
/// distance follows from the hair.
struct CameraChoice {
    std::optional<glm::dvec3> eye, target;
    glm::dvec3 from{0.62, 0.22, -0.75};  // from the hair to the eye; its length has no meaning
    glm::dvec3 up{0, 1, 0};
    double fov = 30;       // full vertical field of view that the distance is made for, degrees
    double margin = 0.05;  // share of half the picture that stays free at each side
    double zoom = 1;       // the picture is narrowed by this factor after the fit
};

/// Parses "eye=x,y,z:target=x,y,z[:up=x,y,z][:fov=degrees]" or
/// "from=x,y,z[:up=x,y,z][:fov=degrees][:margin=share][:zoom=factor]"; an empty text is the default.
/// Throws Error (usage) naming the key, the value and what is allowed.
CameraChoice parse_camera(std::string_view text);

/// The text that parse_camera reads back as this camera: what reports print.
std::string to_string(const Camera& camera);

/// The camera of a choice. With an eye and a target these are taken as they are; otherwise the eye is
/// the nearest one that looks along -from and has every ball (x, y, z, radius) inside the picture of
/// the given aspect (width / height), less the margin. The hair lies between its control points'
/// balls (convex hull), so it is inside too. Throws Error (bad_input) without any point.
Camera framing(std::span<const glm::vec4> balls, double aspect, const CameraChoice& choice = {});
Camera framing(const Curves& curves, double aspect, const CameraChoice& choice = {});
Camera framing(const Box& bounds, double aspect, const CameraChoice& choice = {});

}  // namespace strandlab
