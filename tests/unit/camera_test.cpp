#include "trace/camera.h"

#include "base/error.h"
#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace strandlab {
namespace {

/// Largest coordinate of the balls in the picture (1: its edge), tangent cones included.
struct Extent {
    double right = -1e300, left = -1e300, top = -1e300, bottom = -1e300;
    double across() const { return std::max(left, right); }
    double up() const { return std::max(top, bottom); }
};

Extent picture_extent(const Camera& camera, double aspect, const std::vector<glm::vec4>& balls) {
    const CameraFrame frame = frame_of(camera);
    const double half = camera.fov * std::numbers::pi / 360;
    const double half_across = std::atan(std::tan(half) * aspect);
    Extent extent;
    for (const glm::vec4& ball : balls) {
        const glm::dvec3 v = glm::dvec3(ball) - camera.eye;
        const double z = glm::dot(v, frame.forward);
        // Tangent of the steepest line through the eye that touches the ball's outline.
        const auto reach = [&](double x) {
            return std::tan(std::atan2(x, z) + std::asin(double(ball.w) / std::hypot(x, z)));
        };
        const double x = glm::dot(v, frame.right), y = glm::dot(v, frame.up);
        EXPECT_GT(z, ball.w);
        extent.right = std::max(extent.right, reach(x) / std::tan(half_across));
        extent.left = std::max(extent.left, reach(-x) / std::tan(half_across));
        extent.top = std::max(extent.top, reach(y) / std::tan(half));
        extent.bottom = std::max(extent.bottom, reach(-y) / std::tan(half));
    }
    return extent;
}

std::vector<glm::vec4> random_balls(uint64_t seed, size_t count, double radius) {
    Random random(seed);
    const glm::dvec3 centre(random.range(-3, 3), random.range(-3, 3), random.range(-3, 3));
    const glm::dvec3 size(random.range(0.01, 1), random.range(0.01, 1), random.range(0.01, 1));
    std::vector<glm::vec4> balls;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 offset(random.signed_unit(), random.signed_unit(), random.signed_unit());
        balls.emplace_back(glm::vec3(centre + size * offset), static_cast<float>(radius * random.uniform()));
    }
    return balls;
}

TEST(Camera, FramingHoldsEveryBallAndIsAsNearAsItCanBe) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed, 1);
        const std::vector<glm::vec4> balls = random_balls(seed, 500, 0.05);
        CameraChoice choice;
        choice.from = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
        choice.fov = random.range(2, 120);
        const double aspect = random.range(0.3, 3);
        const Camera camera = framing(balls, aspect, choice);
        const Extent extent = picture_extent(camera, aspect, balls);
        const double limit = 1 - choice.margin;
        EXPECT_LE(extent.across(), limit + 1e-6) << seed;
        EXPECT_LE(extent.up(), limit + 1e-6) << seed;
        // The side that decides is touched, at both ends.
        const bool across_decides = extent.across() > extent.up();
        EXPECT_NEAR(across_decides ? extent.left : extent.bottom, limit, 1e-6) << seed;
        EXPECT_NEAR(across_decides ? extent.right : extent.top, limit, 1e-6) << seed;
    }
}

TEST(Camera, FramingLooksFromTheDirectionAskedFor) {
    const std::vector<glm::vec4> balls = random_balls(7, 100, 0.01);
    const Camera camera = framing(balls, 1.5, parse_camera("from=1,2,-2:fov=40"));
    const glm::dvec3 view = glm::normalize(camera.target - camera.eye);
    EXPECT_LT(glm::length(view + glm::dvec3(1, 2, -2) / 3.0), 1e-12);
    EXPECT_DOUBLE_EQ(camera.fov, 40);
}

TEST(Camera, ZoomNarrowsThePictureFromTheSamePlace) {
    const std::vector<glm::vec4> balls = random_balls(8, 100, 0.01);
    const Camera whole = framing(balls, 1, parse_camera("fov=40")),
                 part = framing(balls, 1, parse_camera("fov=40:zoom=2"));
    EXPECT_EQ(whole.eye, part.eye);
    EXPECT_NEAR(std::tan(part.fov * std::numbers::pi / 360), 0.5 * std::tan(20 * std::numbers::pi / 180),
                1e-12);
}

TEST(Camera, FramesCurvesBoxesAndSinglePoints) {
    Curves curves;
    curves.curves = {{glm::vec4(0, 0, 0, 0.1f), glm::vec4(1, 0, 0, 0.1f), glm::vec4(2, 1, 0, 0.1f),
                      glm::vec4(3, 1, 1, 0.1f)}};
    curves.strands = {{0, 1}};
    const std::vector<glm::vec4> balls(curves.curves[0].begin(), curves.curves[0].end());
    EXPECT_EQ(framing(curves, 2).eye, framing(balls, 2).eye);

    Box box;
    box.add(glm::vec3(-1, -2, -3));
    box.add(glm::vec3(1, 2, 3));
    const Extent extent =
        picture_extent(framing(box, 1), 1, {glm::vec4(-1, -2, -3, 0), glm::vec4(1, 2, 3, 0)});
    EXPECT_LT(extent.across(), 1);
    EXPECT_LT(extent.up(), 1);

    const std::vector<glm::vec4> point{glm::vec4(5, 5, 5, 0)};
    const Camera at_point = framing(point, 1);
    EXPECT_GT(glm::distance(at_point.eye, glm::dvec3(5)), 0);
    EXPECT_LT(picture_extent(at_point, 1, point).across(), 1e-6);
}

TEST(Camera, NothingToFrameIsAnError) {
    for (const auto& frame : {+[] { framing(Curves{}, 1); }, +[] { framing(Box{}, 1); }}) try {
            frame();
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::bad_input);
        }
}

TEST(Camera, FrameIsOrthonormalEvenWhenUpIsParallelToTheView) {
    for (const glm::dvec3 from : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 2, 3)}) {
        const CameraFrame frame = frame_of({from, glm::dvec3(0), {0, 1, 0}, 30});
        EXPECT_NEAR(glm::length(frame.right), 1, 1e-12);
        EXPECT_NEAR(glm::length(frame.up), 1, 1e-12);
        EXPECT_NEAR(glm::dot(frame.right, frame.up), 0, 1e-12);
        EXPECT_LT(glm::length(glm::cross(frame.right, frame.up) + frame.forward), 1e-12);
    }
    EXPECT_LT(glm::length(world_direction({{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30}, {0, 3, 4}) -
                          glm::dvec3(0, 0.6, 0.8)),
              1e-12);
}

TEST(CameraText, PlacedCameraRoundTrips) {
    const CameraChoice choice = parse_camera("eye=1,2.5,-3e-2:target=0,0,1:up=0,0,1:fov=42.5");
    const Camera camera = framing(Curves{}, 1, choice);
    EXPECT_EQ(camera.eye, glm::dvec3(1, 2.5, -0.03));
    EXPECT_EQ(camera.target, glm::dvec3(0, 0, 1));
    EXPECT_EQ(camera.up, glm::dvec3(0, 0, 1));
    EXPECT_EQ(camera.fov, 42.5);
    const Camera again = framing(Curves{}, 1, parse_camera(to_string(camera)));
    EXPECT_EQ(again.eye, camera.eye);
    EXPECT_EQ(again.fov, camera.fov);
    const Camera fitted = framing(random_balls(3, 50, 0.1), 1.7, parse_camera("zoom=3"));
    const Camera reread = framing(Curves{}, 1, parse_camera(to_string(fitted)));
    EXPECT_EQ(reread.eye, fitted.eye);
    EXPECT_EQ(reread.target, fitted.target);
    EXPECT_EQ(reread.fov, fitted.fov);
}

std::string message_of(std::string_view text) {
    try {
        parse_camera(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::usage);
        return error.what();
    }
    return "";
}

TEST(CameraText, ErrorsNameKeyValueAndWhatToWrite) {
    EXPECT_EQ(message_of(""), "");
    const std::pair<const char*, const char*> cases[] = {
        {"ey=1,2,3", "did you mean 'eye'"},
        {"zzzzzzz=1", "it has eye, target, from, up, fov, margin and zoom"},
        {"eye", "'eye' is not key=value"},
        {"fov=10:", "'' is not key=value"},
        {"eye=1,2,3", "target is missing"},
        {"target=1,2,3", "eye is missing"},
        {"eye=1,2,3:target=1,2,3", "two different points"},
        {"eye=0,5,0:target=0,0,0", "up is parallel to the view"},
        {"eye=1,2:target=0,0,0", "eye=1,2 is not three numbers"},
        {"eye=1,2,x:target=0,0,0", "eye=1,2,x is not three numbers"},
        {"eye=1,2,nan:target=0,0,0", "not three numbers"},
        {"from=1,2,inf", "not three numbers"},
        {"from=0,0,0", "from=0,0,0 is no direction"},
        {"up=0,0,0", "up=0,0,0 is no direction"},
        {"from=1,2,3:eye=1,2,3:target=0,0,0", "do not go together"},
        {"eye=1,2,3:target=0,0,0:zoom=2", "do not go together"},
        {"fov=0", "fov=0 is not a number from 0.01 to 170"},
        {"fov=nan", "fov=nan is not a number"},
        {"margin=1", "margin=1 is not a number from 0 to 0.9"},
        {"fov=30:fov=40", "fov is given twice"},
    };
    for (const auto& [text, expected] : cases)
        EXPECT_NE(message_of(text).find(expected), std::string::npos) << text << " -> " << message_of(text);
}

}  // namespace
}  // namespace strandlab
