// How strand ends are closed. Interior joints stay closed for every primitive.
#pragma once

#include <optional>
#include <string_view>

namespace strandlab {

/// round: a sphere of the end radius; open: a hole; flat: a disc across the end.
enum class Caps { round, open, flat };

constexpr std::string_view name_of(Caps caps) {
    return caps == Caps::round ? "round" : caps == Caps::open ? "open" : "flat";
}

constexpr std::optional<Caps> caps_named(std::string_view name) {
    for (const Caps caps : {Caps::round, Caps::open, Caps::flat})
        if (name == name_of(caps)) return caps;
    return std::nullopt;
}

}  // namespace strandlab
