// Single curves that break intersectors: one strand of one curve for each case, or all of them in a row.
#include "strands/generator_parts.h"

namespace strandlab {
namespace {

struct Case {
    std::string name;
    Curve curve;  // about one unit long, radius 0.05
};

Curve curve_of(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, glm::vec4 radii = glm::vec4(0.05f)) {
    return {glm::vec4(a, radii[0]), glm::vec4(b, radii[1]), glm::vec4(c, radii[2]), glm::vec4(d, radii[3])};
}

const std::vector<Case>& cases() {
    static const std::vector<Case> list{
        {"arc", curve_of({0, 0, 0}, {0.3f, 0.2f, 0}, {0.7f, 0.2f, 0}, {1, 0, 0})},
        {"line", curve_of({0, 0, 0}, {1.0f / 3, 0, 0}, {2.0f / 3, 0, 0}, {1, 0, 0})},
        {"point", curve_of({0.5f, 0, 0}, {0.5f, 0, 0}, {0.5f, 0, 0}, {0.5f, 0, 0})},
        {"closed", curve_of({0, 0, 0}, {0.8f, 0.5f, 0}, {-0.8f, 0.5f, 0}, {0, 0, 0})},  // chord of length 0
        {"repeated_start", curve_of({0, 0, 0}, {0, 0, 0}, {0.6f, 0.3f, 0.1f}, {1, 0, 0})},
        {"repeated_end", curve_of({0, 0, 0}, {0.4f, 0.3f, 0.1f}, {1, 0, 0}, {1, 0, 0})},
        {"repeated_both", curve_of({0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0})},
        {"repeated_middle", curve_of({0, 0, 0}, {0.5f, 0.4f, 0}, {0.5f, 0.4f, 0}, {1, 0, 0})},
        {"cusp", curve_of({0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0})},  // C'(1/2) = 0 exactly
        {"fold_back",
         curve_of({0, 0, 0}, {1.5f, 0, 0}, {-0.5f, 0, 0}, {1, 0, 0})},              // passes itself on a line
        {"overshoot", curve_of({0, 0, 0}, {1, 0, 0}, {1.4f, 0, 0}, {0.6f, 0, 0})},  // turns round on a line
        {"loop", curve_of({0, 0, 0}, {1.5f, 1, 0}, {-0.5f, 1, 0}, {1, 0, 0})},
        {"s_bend", curve_of({0, 0, 0}, {0.4f, 0.8f, 0}, {0.6f, -0.8f, 0}, {1, 0, 0})},
        {"hairpin",
         curve_of({0, 0, 0}, {1.3f, 0, 0}, {1.3f, 0.15f, 0}, {0, 0.15f, 0})},  // turns by 180 degrees
        {"twisted", curve_of({0, 0, 0}, {0.5f, 0.8f, 0}, {0.5f, 0, 0.8f}, {1, 0.1f, 0.1f})},
        {"zero_tip",
         curve_of({0, 0, 0}, {0.3f, 0.2f, 0}, {0.7f, 0.2f, 0}, {1, 0, 0}, {0.05f, 0.03f, 0.01f, 0})},
        {"zero_radius", curve_of({0, 0, 0}, {0.3f, 0.2f, 0}, {0.7f, 0.2f, 0}, {1, 0, 0}, glm::vec4(0))},
        {"thick_bend", curve_of({0, 0, 0}, {0.5f, 0.5f, 0}, {0.5f, 0.5f, 0}, {1, 0, 0}, glm::vec4(0.4f))},
        {"hard_taper",
         curve_of({0, 0, 0}, {0.3f, 0, 0}, {0.7f, 0, 0}, {1, 0, 0}, {1.1f, 0.7f, 0.1f, 0.001f})},
        {"engulfed", curve_of({0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.3f, 0, 0}, {0.5f, 0.3f, 0.2f, 0.1f})},
        {"bulge",
         curve_of({0, 0, 0}, {0.3f, 0.1f, 0}, {0.7f, 0.1f, 0}, {1, 0, 0}, {0.01f, 0.3f, 0.3f, 0.01f})},
    };
    return list;
}

Curves make_cases(const Parameters& parameters) {
    const double size = parameters.number("size"), radius = parameters.number("radius"),
                 distance = parameters.number("distance");
    Curves result;
    for (const Case& c : cases()) {
        if (!parameters.is("case", "all") && !parameters.is("case", c.name)) continue;
        const auto index = static_cast<uint32_t>(result.curves.size());
        Curve curve;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p = glm::dvec3(c.curve[i]) + glm::dvec3(distance, 2.0 * index, 0);
            curve[i] = glm::vec4(glm::dvec4(size * p, size * radius * double(c.curve[i].w)));
        }
        result.curves.push_back(curve);
        result.strands.push_back({index, 1});
    }
    return result;
}

}  // namespace

Generator cases_generator() {
    std::vector<std::string> names{"all"};
    for (const Case& c : cases()) names.push_back(c.name);
    return {"case",
            "one degenerate or hard curve, or all, one above the other",
            {{"case", "which curve", "all", 0, 0, false, names},
             {"size", "length of a curve, m: 1e-6 and 1e6 are worth a test", "1", 1e-8, 1e7},
             {"radius", "multiplies the radii", "1", 0, 1000},
             {"distance", "moves the curves along x by this many lengths", "0", -1e6, 1e6}},
            make_cases};
}

}  // namespace strandlab
