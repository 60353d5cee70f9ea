// Names of files from names of models, primitives and devices.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// The text as a part of a file's name that is one anywhere: letters, digits, '-', '=' and, for runs of
/// anything else, '_'; at most 60 characters; "unnamed" where nothing is left.
std::string file_name_of(std::string_view text);

/// The same of each text, and no two alike: names that another one has already get "-2", "-3" and so on.
std::vector<std::string> file_names_of(std::span<const std::string> texts);

}  // namespace strandlab
