// Lists of choices in one specification: the axes of a sweep.
#pragma once

#include "primitives/primitive.h"

#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// The specifications that one with lists stands for: "lss:segments=1,2,4" is three, "prhi:splits=1..8" eight
/// (whole numbers, both ends included), and several lists every combination, the last one fastest. What is no
/// list comes back as it is. Throws Error (usage) for a range that is empty or has more than 1000 numbers.
std::vector<std::string> expand_lists(std::string_view specification);

/// Parses each of them as parse_primitive does.
std::vector<PrimitiveChoice> parse_primitives(std::string_view text, std::string_view caps = {});

}  // namespace strandlab
