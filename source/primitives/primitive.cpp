#include "primitives/primitive.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>

namespace strandlab {
namespace {

Caps choose_caps(const Primitive& primitive, std::string_view asked) {
    const auto can = [&](Caps caps) {
        return std::find(primitive.caps.begin(), primitive.caps.end(), caps) != primitive.caps.end();
    };
    if (asked.empty()) return can(Caps::round) ? Caps::round : primitive.caps.front();
    const auto caps = caps_named(asked);
    if (!caps) fail(ExitCode::usage, "--caps {}: must be round, open or flat", asked);
    if (!can(*caps)) {
        std::vector<std::string> possible;
        for (const Caps c : primitive.caps) possible.emplace_back(name_of(c));
        fail(ExitCode::usage, "--caps {}: {} can do {} only", asked, primitive.name, list_of(possible));
    }
    return *caps;
}

}  // namespace

const Primitive& primitive_named(std::string_view name) {
    std::vector<std::string> names;
    for (const Primitive& primitive : primitives()) {
        if (primitive.name == name) return primitive;
        names.push_back(primitive.name);
    }
    const auto guess = nearest(name, names);
    fail(ExitCode::usage, "--primitive {}: no such primitive{}; there are {}", name,
         guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(names, "and"));
}

PrimitiveChoice parse_primitive(std::string_view text, std::string_view caps) {
    const size_t colon = text.find(':');
    const Primitive& primitive = primitive_named(text.substr(0, colon));
    Parameters parameters(primitive.parameters);
    if (colon != std::string_view::npos)
        parameters.set_all(fmt::format("--primitive {}", primitive.name), primitive.parameters,
                           text.substr(colon + 1));
    return {&primitive, {std::move(parameters), choose_caps(primitive, caps)}};
}

std::string PrimitiveChoice::label() const {
    const std::string parameters = options.parameters.to_string(primitive->parameters);
    return parameters.empty() ? primitive->name : primitive->name + ":" + parameters;
}

}  // namespace strandlab
