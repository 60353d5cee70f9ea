#include "strands/generators.h"

#include "base/error.h"
#include "base/sine.h"
#include "base/text.h"
#include "strands/generator_parts.h"

#include <cmath>
#include <limits>

namespace strandlab {
namespace {

constexpr std::string_view prefix = "generate:";

const Generator& generator_named(std::string_view name) {
    std::vector<std::string> names;
    for (const Generator& generator : generators()) {
        if (generator.name == name) return generator;
        names.push_back(generator.name);
    }
    const auto guess = nearest(name, names);
    fail(ExitCode::usage, "generate:{}: no such generator{}; there are {}", name,
         guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(names, "and"));
}

void check_size(const std::string& context, const Generator& generator, const Parameters& parameters) {
    for (const char* key : {"strands", "points"})
        if (std::none_of(generator.parameters.begin(), generator.parameters.end(),
                         [&](const ParameterInfo& p) { return p.name == key; }))
            return;
    const double points = parameters.number("strands") * parameters.number("points");
    if (points > double(std::numeric_limits<uint32_t>::max()))
        fail(ExitCode::usage, "{}: strands x points is {:.0f}, above 2^32 - 1", context, points);
}

}  // namespace

const std::vector<Generator>& generators() {
    static const std::vector<Generator> list{
        patch_generator("straight"),
        patch_generator("wavy"),
        patch_generator("helix"),
        head_generator(),
        fur_generator(),
        cases_generator(),
    };
    return list;
}

bool is_generator_spec(std::string_view model) { return model.substr(0, prefix.size()) == prefix; }

Curves generate(std::string_view spec) {
    if (!is_generator_spec(spec)) fail(ExitCode::usage, "{}: not generate:NAME,key=value,...", spec);
    const std::string_view text = spec.substr(prefix.size());
    const size_t comma = text.find(',');
    const Generator& generator = generator_named(text.substr(0, comma));
    const std::string context = std::string(prefix) + generator.name;
    Parameters parameters(generator.parameters);
    if (comma != std::string_view::npos)
        parameters.set_all(context, generator.parameters, text.substr(comma + 1));
    check_size(context, generator, parameters);
    return generator.make(parameters);
}

std::vector<ParameterInfo> common_parameters(std::string strands, std::string points, std::string length,
                                             std::string length_variation) {
    return {
        {"strands", "number of strands", std::move(strands), 1, 1e8, true},
        {"points", "control points of a strand", std::move(points), 2, 65536, true},
        {"seed", "seed of the random numbers", "1", 0, 4294967295.0, true},
        {"length", "mean length of a strand, m", std::move(length), 1e-6, 1e6},
        {"length_variation", "largest relative deviation of a length", std::move(length_variation), 0, 1},
        {"root_radius", "radius at the root, m", "35e-6", 0, 1e6},
        {"tip_radius", "radius at the tip, m", "10e-6", 0, 1e6},
    };
}

glm::dvec3 any_orthogonal(const glm::dvec3& n) {
    const glm::dvec3 a = glm::abs(n);
    const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                            : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(n, axis));
}

glm::dvec3 random_direction(Random& random) {
    const double z = random.signed_unit();
    const SinCos angle = sin_cos(tau * random.uniform());
    const double r = std::sqrt(1 - z * z);
    return {r * angle.cos, r * angle.sin, z};
}

}  // namespace strandlab
