#include "strands/rod.h"

#include "base/sine.h"
#include "strands/generator_parts.h"

#include <array>

namespace strandlab {
namespace {

/// Slow turning: a sine of the arc length for each axis.
struct Wander {
    std::array<double, 3> phase, frequency;

    Wander(Random& random, double length) {
        for (int i = 0; i < 3; ++i) {
            phase[i] = tau * random.uniform();
            frequency[i] = tau * random.range(0.8, 3.2) / length;
        }
    }
    glm::dvec3 at(double s) const {
        glm::dvec3 turning;
        for (int i = 0; i < 3; ++i) turning[i] = sin_cos(phase[i] + frequency[i] * s).sin;
        return turning;
    }
};

glm::dvec3 without_component(const glm::dvec3& v, const glm::dvec3& unit) {
    return v - unit * glm::dot(v, unit);
}

/// Pushes a step that is inside the ellipsoid, scaled by level, back onto it and turns it outwards.
void keep_outside(const glm::dvec3& semi_axes, double level, RodStep& step) {
    const double rho = glm::length(step.position / semi_axes);
    if (!(rho < level)) return;
    step.position *= level / std::max(rho, 1e-3);
    const glm::dvec3 normal = glm::normalize(step.position / (semi_axes * semi_axes));
    const double inwards = glm::dot(step.direction, normal);
    const glm::dvec3 along = step.direction - normal * inwards;
    if (inwards < 0 && glm::length(along) > 1e-6) step.direction = glm::normalize(along);
}

}  // namespace

double grow_rod(const RodStyle& style, Random& random, const glm::dvec3& u, const glm::dvec3& comb,
                size_t steps, std::vector<RodStep>& path) {
    const glm::dvec3 normal = glm::normalize(u / style.semi_axes);
    glm::dvec3 combed = without_component(comb, normal);
    combed = glm::length(combed) > 1e-6 ? glm::normalize(combed) : any_orthogonal(normal);
    // Braces: their items are drawn in order, those of parentheses in any.
    const glm::dvec3 scatter{random.signed_unit(), random.signed_unit(), random.signed_unit()};
    const double length = style.length * (1 + style.length_variation * random.signed_unit());
    const double gravity = style.gravity * (1 + 0.25 * random.signed_unit());
    const double layer = style.layer * random.uniform();
    const Wander wander(random, style.length);

    RodStep step{u * style.semi_axes,
                 glm::normalize(style.lift * normal + (1 - style.lift) * combed + 0.15 * scatter),
                 {}};
    step.normal = any_orthogonal(step.direction);
    const double ds = length / double(steps);
    path.clear();
    path.push_back(step);
    for (size_t i = 0; i < steps; ++i) {
        const double s = (double(i) + 0.5) * ds;
        const glm::dvec3 turning = style.wander * wander.at(s) + glm::dvec3(0, -gravity, 0);
        step.direction = glm::normalize(step.direction + ds * without_component(turning, step.direction));
        step.position += ds * step.direction;
        keep_outside(style.semi_axes, 1 + layer * s / (s + 0.05 * style.length), step);
        step.normal = glm::normalize(without_component(step.normal, step.direction));
        path.push_back(step);
    }
    return length;
}

}  // namespace strandlab
