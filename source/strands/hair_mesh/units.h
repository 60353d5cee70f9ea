// Units of length by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace strandlab {

inline constexpr std::array<std::pair<std::string_view, double>, 3> length_units{
    {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}}};

/// Metres of a unit; nothing when there is no such unit.
constexpr std::optional<double> unit_named(std::string_view name) {
    for (const auto& [unit, metres] : length_units)
        if (unit == name) return metres;
    return std::nullopt;
}

}  // namespace strandlab
