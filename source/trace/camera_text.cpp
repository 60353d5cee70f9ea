// The text form of a camera: what --camera takes and reports print.
#include "base/error.h"
#include "base/text.h"
#include "trace/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace strandlab {
namespace {

constexpr std::string_view forms = "eye=x,y,z:target=x,y,z or from=x,y,z";

glm::dvec3 parse_vector(std::string_view key, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ',');
    glm::dvec3 vector(0);
    bool good = parts.size() == 3;
    for (int axis = 0; good && axis < 3; ++axis) {
        const auto number = to_number(parts[axis]);
        good = number && std::isfinite(*number);
        if (good) vector[axis] = *number;
    }
    if (!good) fail(ExitCode::usage, "--camera: {}={} is not three numbers x,y,z", key, text);
    return vector;
}

glm::dvec3 parse_direction(std::string_view key, std::string_view text) {
    const glm::dvec3 direction = parse_vector(key, text);
    const double length = glm::length(direction);
    if (!(length > 0 && std::isfinite(length)))
        fail(ExitCode::usage, "--camera: {}={} is no direction: it must not be zero or overflow", key, text);
    return direction / length;
}

double parse_number(std::string_view key, std::string_view text, double low, double high) {
    const auto number = to_number(text);
    if (!number || !(*number >= low && *number <= high))
        fail(ExitCode::usage, "--camera: {}={} is not a number from {:g} to {:g}", key, text, low, high);
    return *number;
}

/// One key of the text; only says which of the two forms it belongs to (both when neither is set).
struct Key {
    std::string_view name;
    bool placed, automatic;
    void (*set)(CameraChoice& choice, std::string_view key, std::string_view value);
};

using Text = std::string_view;
constexpr std::array keys = {
    Key{"eye", true, false, [](CameraChoice& c, Text key, Text value) { c.eye = parse_vector(key, value); }},
    Key{"target", true, false,
        [](CameraChoice& c, Text key, Text value) { c.target = parse_vector(key, value); }},
    Key{"from", false, true,
        [](CameraChoice& c, Text key, Text value) { c.from = parse_direction(key, value); }},
    Key{"up", false, false,
        [](CameraChoice& c, Text key, Text value) { c.up = parse_direction(key, value); }},
    Key{"fov", false, false,
        [](CameraChoice& c, Text key, Text value) { c.fov = parse_number(key, value, 0.01, 170); }},
    Key{"margin", false, true,
        [](CameraChoice& c, Text key, Text value) { c.margin = parse_number(key, value, 0, 0.9); }},
    Key{"zoom", false, true,
        [](CameraChoice& c, Text key, Text value) { c.zoom = parse_number(key, value, 0.01, 1000); }},
};

const Key& key_named(std::string_view name) {
    const auto found =
        std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
    if (found != keys.end()) return *found;
    std::vector<std::string> names;
    for (const Key& key : keys) names.emplace_back(key.name);
    const auto guess = nearest(name, names);
    fail(ExitCode::usage, "--camera: no key '{}'{}; it has {}", name,
         guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(names, "and"));
}

void check_placed(const CameraChoice& choice) {
    if (!choice.eye || !choice.target)
        fail(ExitCode::usage, "--camera: {} is missing; write eye=x,y,z:target=x,y,z",
             choice.eye ? "target" : "eye");
    const glm::dvec3 view = *choice.target - *choice.eye;
    const double length = glm::length(view);
    if (!(length > 0 && std::isfinite(length)))
        fail(ExitCode::usage, "--camera: eye and target must be two different points");
    if (!(glm::length(glm::cross(view / length, choice.up)) > 1e-9))
        fail(ExitCode::usage, "--camera: up is parallel to the view; give another, such as up=0,0,1");
}

}  // namespace

CameraChoice parse_camera(std::string_view text) {
    CameraChoice choice;
    std::vector<std::string_view> seen;
    std::string_view placed, automatic;
    for (const std::string_view part : split(text, ':')) {
        const size_t equals = part.find('=');
        if (equals == std::string_view::npos)
            fail(ExitCode::usage, "--camera: '{}' is not key=value; write {}", part, forms);
        const Key& key = key_named(part.substr(0, equals));
        if (std::find(seen.begin(), seen.end(), key.name) != seen.end())
            fail(ExitCode::usage, "--camera: {} is given twice", key.name);
        seen.push_back(key.name);
        if (key.placed) placed = key.name;
        if (key.automatic) automatic = key.name;
        key.set(choice, key.name, part.substr(equals + 1));
    }
    if (!placed.empty() && !automatic.empty())
        fail(ExitCode::usage, "--camera: {} and {} do not go together; write {}", placed, automatic, forms);
    if (!placed.empty()) check_placed(choice);
    return choice;
}

std::string to_string(const Camera& camera) {
    const auto vector = [](const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    return fmt::format("eye={}:target={}:up={}:fov={}", vector(camera.eye), vector(camera.target),
                       vector(camera.up), camera.fov);
}

}  // namespace strandlab
