// Strands that stand on a square patch: straight, wavy and helical ones, plain enough to reason about.
#include "base/sine.h"
#include "strands/generator_parts.h"

namespace strandlab {
namespace {

/// Sideways displacement of a strand at arc length s of its axis, in the plane across it.
using Displacement = glm::dvec2 (*)(double amplitude, double phase);

glm::dvec2 no_displacement(double, double) { return glm::dvec2(0); }
glm::dvec2 wave(double amplitude, double phase) { return {amplitude * sin_cos(phase).sin, 0}; }
glm::dvec2 turn(double amplitude, double phase) {
    const SinCos angle = sin_cos(phase);
    return {amplitude * angle.cos, amplitude * angle.sin};
}

template <Displacement displacement>
Curves make_patch(const Parameters& parameters) {
    const uint64_t seed = parameters.integer("seed");
    const double size = parameters.number("size"), lean = parameters.number("lean"),
                 length = parameters.number("length"), variation = parameters.number("length_variation");
    const bool is_bent = displacement != no_displacement;
    const double amplitude = is_bent ? parameters.number("amplitude") : 0;
    const double period = is_bent ? parameters.number("period") : 1;
    return grow_strands(parameters, [&] {
        return [&](size_t strand, std::span<glm::vec4> points) {
            Random random(seed, 1, strand);
            // Braces: their items are drawn in order, those of parentheses in any.
            const glm::dvec3 root{0.5 * size * random.signed_unit(), 0, 0.5 * size * random.signed_unit()};
            const glm::dvec3 tilt{lean * random.signed_unit(), 0, lean * random.signed_unit()};
            const glm::dvec3 up = glm::normalize(glm::dvec3(0, 1, 0) + tilt);
            const glm::dvec3 side = any_orthogonal(up), other = glm::cross(up, side);
            const double own_length = length * (1 + variation * random.signed_unit());
            const double first_phase = tau * random.uniform();
            const glm::dvec2 start = displacement(amplitude, first_phase);  // the root itself stays in place
            for (size_t i = 0; i < points.size(); ++i) {
                const double s = own_length * double(i) / double(points.size() - 1);
                const glm::dvec2 d = displacement(amplitude, first_phase + tau * s / period) - start;
                points[i] = glm::vec4(glm::dvec4(root + up * s + side * d.x + other * d.y, 0));
            }
        };
    });
}

}  // namespace

Generator patch_generator(std::string name) {
    std::vector<ParameterInfo> parameters = common_parameters("1000", "16", "0.1", "0.1");
    parameters.push_back({"size", "side of the square that holds the roots, m", "0.1", 0, 1e6});
    parameters.push_back({"lean", "largest sideways lean per length", "0.1", 0, 10});
    if (name == "straight")
        return {name, "straight strands on a square patch", parameters, make_patch<no_displacement>};
    parameters.push_back(
        {"amplitude", "half the width of a wave, or the radius of a turn, m", "0.004", 0, 1e6});
    parameters.push_back({"period", "length of a wave or a turn, m", "0.025", 1e-6, 1e6});
    if (name == "wavy") return {name, "plane waves on a square patch", parameters, make_patch<wave>};
    return {name, "helices on a square patch", parameters, make_patch<turn>};
}

}  // namespace strandlab
