// Short hair all over an ellipsoid.
#include "strands/generator_parts.h"
#include "strands/rod.h"

namespace strandlab {
namespace {

Curves make_fur(const Parameters& parameters) {
    RodStyle style;
    style.semi_axes = {parameters.number("x_radius"), parameters.number("y_radius"),
                       parameters.number("z_radius")};
    style.length = parameters.number("length");
    style.length_variation = parameters.number("length_variation");
    style.lift = parameters.number("lift");
    style.gravity = parameters.number("gravity");
    style.wander = parameters.number("wander");
    style.layer = 0.05;
    const uint64_t seed = parameters.integer("seed");
    return grow_strands(parameters, [&] {
        return [&, path = std::vector<RodStep>()](size_t strand, std::span<glm::vec4> points) mutable {
            constexpr size_t steps_per_curve = 4;
            Random random(seed, 1, strand);
            const glm::dvec3 u = random_direction(random);
            grow_rod(style, random, u, {0.1, -0.4, -1}, (points.size() - 1) * steps_per_curve, path);
            for (size_t i = 0; i < points.size(); ++i)
                points[i] = glm::vec4(glm::dvec4(path[i * steps_per_curve].position, 0));
        };
    });
}

}  // namespace

Generator fur_generator() {
    std::vector<ParameterInfo> parameters = common_parameters("20000", "4", "0.025", "0.25");
    parameters.push_back({"x_radius", "semi-axis of the body, m", "0.078", 1e-6, 1e6});
    parameters.push_back({"y_radius", "semi-axis of the body, m", "0.105", 1e-6, 1e6});
    parameters.push_back({"z_radius", "semi-axis of the body, m", "0.095", 1e-6, 1e6});
    parameters.push_back({"lift", "1: hairs stand on the skin, 0: combed flat to the back", "0.6", 0, 1});
    parameters.push_back({"gravity", "turning towards the ground, 1/m", "14", 0, 1000});
    parameters.push_back({"wander", "slow random turning, 1/m", "25", 0, 1000});
    return {"fur", "fur on an ellipsoid", parameters, make_fur};
}

}  // namespace strandlab
