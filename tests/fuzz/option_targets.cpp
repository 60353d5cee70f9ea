#include "fuzz/option_targets.h"

#include "base/text.h"
#include "commands/arguments.h"
#include "fuzz/input_reader.h"
#include "fuzz/load_bytes.h"
#include "fuzz/refusal.h"
#include "primitives/primitive.h"
#include "strands/generators.h"
#include "trace/camera.h"
#include "trace/ray_sets.h"

#include <array>
#include <cmath>

namespace strandlab::fuzz {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void run_camera(Bytes input) {
    const std::string text = InputReader(input).text();
    CameraChoice choice;
    if (!accepts([&] { choice = parse_camera(text); })) return;
    const std::array<glm::vec4, 2> balls{glm::vec4(0, 1, 0, 0.1f), glm::vec4(2, -1, 0.5f, 0)};
    Camera camera;
    if (!accepts([&] { camera = framing(balls, 1.5, choice); })) return;
    require(is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up), "no finite camera");
    require(camera.fov > 0 && camera.fov < 180, "no field of view");
    const CameraFrame frame = frame_of(camera);
    for (const glm::dvec3& axis : {frame.right, frame.up, frame.forward})
        require(std::abs(glm::length(axis) - 1) < 1e-9, "an axis that is not of unit length");
    for (const Ray& ray : primary_rays(camera, {3, 2, 1}).rays) {
        // Eyes beyond what float holds are refused where rays are traced.
        if (glm::length(camera.eye) < 1e30) require(is_valid(ray), "a camera ray that is not valid");
    }
}

std::vector<std::string> camera_seeds() {
    return {"eye=1,2,3:target=0,0,0:up=0,0,1:fov=45", "from=0.62,0.22,-0.75:margin=0.1:zoom=2", "",
            "from=0,1,0:fov=10"};
}

/// Strands x points that a specification asks for; 0 where it is refused.
double points_of(std::string_view spec) {
    const size_t colon = spec.find(':'), comma = spec.find(',');
    if (!is_generator_spec(spec)) return 0;
    for (const Generator& generator : generators()) {
        if (generator.name != spec.substr(colon + 1, comma - colon - 1)) continue;
        Parameters parameters(generator.parameters);
        if (comma != std::string_view::npos)
            parameters.set_all("", generator.parameters, spec.substr(comma + 1));
        double points = 1;
        for (const ParameterInfo& info : generator.parameters)
            if (info.name == "strands" || info.name == "points") points *= parameters.number(info.name);
        return points;
    }
    return 0;
}

void run_generator(Bytes input) {
    const std::string spec = InputReader(input).text();
    double points = 0;
    accepts([&] { points = points_of(spec); });
    if (points > 5000) return;  // work, not a finding
    Curves curves;
    if (accepts([&] { curves = generate(spec); })) require_invariants(curves);
}

std::vector<std::string> generator_seeds() {
    std::vector<std::string> all{"generate:", "straight"};
    for (const Generator& generator : generators()) {
        Parameters parameters(generator.parameters);
        all.push_back("generate:" + generator.name);
        all.push_back("generate:" + generator.name + "," + parameters.to_string(generator.parameters, true));
        for (const ParameterInfo& info : generator.parameters)
            if (info.name == "strands" || info.name == "points")
                parameters.set("", generator.parameters, info.name, "3");
        all.push_back("generate:" + generator.name + "," + parameters.to_string(generator.parameters, true));
    }
    return all;
}

void check_primitive(const std::string& text, std::string_view caps) {
    std::string label;
    if (!accepts([&] { label = parse_primitive(text, caps).label(); })) return;
    require(parse_primitive(label, caps).label() == label, "a label that reads back as another: " + label);
}

void check_resolution(const std::string& text) {
    Resolution size;
    if (accepts([&] { size = parse_resolution(text); })) require(size.width > 0 && size.height > 0, "empty");
}

void run_options(Bytes input) {
    InputReader reader(input);
    const uint32_t which = reader.below(6);
    const std::string text = reader.text();
    constexpr std::array<std::string_view, 4> caps{"", "round", "open", "flat"};
    if (which < caps.size()) return check_primitive(text, caps[which]);
    if (which == 4) return check_resolution(text);
    accepts([&] { ray_set_named(text); });
    to_number(text);
    const std::string line = one_line(text);
    for (const char c : line)
        require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "a control character in a message");
}

std::vector<std::string> option_seeds() {
    std::vector<std::string> all;
    for (const Primitive& primitive : primitives()) {
        const Parameters parameters(primitive.parameters);
        all.push_back(std::string(1, '\0') + primitive.name + ":" +
                      parameters.to_string(primitive.parameters, true));
    }
    all.push_back(std::string(1, '\2') + "rocaps:epsilon=0.1,splits=8");
    all.push_back(std::string(1, '\4') + "640x360");
    all.push_back(std::string(1, '\5') + "secondary");
    all.push_back(std::string(1, '\5') + "-1.5e3");
    return all;
}

}  // namespace

FuzzTarget camera_target() { return {"camera", run_camera, camera_seeds}; }
FuzzTarget generator_target() { return {"generator", run_generator, generator_seeds}; }
FuzzTarget options_target() { return {"options", run_options, option_seeds}; }

}  // namespace strandlab::fuzz
