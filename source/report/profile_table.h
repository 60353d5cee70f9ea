// Profiles of result rows as a terminal table.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>

namespace strandlab {

/// A table of the rows that have a profile, what drivers tell of their shaders below it, and how to read it;
/// empty without such rows.
std::string profile_table(std::span<const nlohmann::ordered_json> rows);

}  // namespace strandlab
