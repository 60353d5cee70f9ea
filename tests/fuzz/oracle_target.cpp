// The oracle, on every kind of surface.
#include "fuzz/intersector_targets.h"
#include "fuzz/ray_and_curves.h"
#include "primitives/primitive.h"
#include "trace/oracle.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace strandlab::fuzz {
namespace {

struct Kind {
    const char* primitive;
    const char* caps;
};
constexpr std::array<Kind, 7> kinds{{{"rocaps", "round"},
                                     {"rocaps", "open"},
                                     {"prhi", "open"},
                                     {"prhi", "flat"},
                                     {"lss:segments=3", "round"},
                                     {"lss:segments=1", "open"},
                                     {"dots:segments=2", "open"}}};
constexpr std::array<OracleOptions, 4> variations{{{}, {1.001, 8, 1e-3}, {0.999, 8, -1e-3}, {1, 0, 0, true}}};

void run(Bytes bytes) {
    InputReader reader(bytes);
    const Kind& kind = kinds[reader.below(kinds.size())];
    const OracleOptions& options = variations[reader.below(variations.size())];
    const RayAndCurves input = take_ray_and_curves(reader);
    const PrimitiveChoice choice = parse_primitive(kind.primitive, kind.caps);
    const Surface surface = choice.primitive->surface(input.curves, choice.options);
    const ReferenceHit hit = Oracle(surface, options).trace(input.ray);
    if (!hit.is_hit()) return require(std::isinf(hit.t) && hit.t > 0, "a miss at a distance");
    require(is_valid(input.ray), "an invalid ray hits");
    require(hit.t >= double(input.ray.tmin) && hit.t <= double(input.ray.tmax),
            fmt::format("t = {} outside of [tmin, tmax]", hit.t));
    require(hit.u >= 0 && hit.u <= 1, fmt::format("u = {} outside of [0, 1]", hit.u));
    require(hit.curve < input.curves.curves.size(), "a curve that is not there");
    require(std::abs(glm::length(hit.normal) - 1) < 1e-6,
            fmt::format("normal {} {} {} is not unit", hit.normal.x, hit.normal.y, hit.normal.z));
    require(hit.radius >= 0, "a negative radius");
}

std::vector<std::string> seeds() {
    std::vector<std::string> all;
    for (size_t kind = 0; kind < kinds.size(); ++kind)
        for (const std::string& input : ray_and_curves_seeds())
            all.push_back(std::string{static_cast<char>(kind), static_cast<char>(all.size() % 4)} + input);
    return all;
}

}  // namespace

FuzzTarget oracle_target() { return {"oracle", run, seeds}; }

}  // namespace strandlab::fuzz
