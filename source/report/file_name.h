// Names of files from names of models, primitives and devices.
#pragma once

#include <string>
#include <string_view>

namespace strandlab {

/// The text as a part of a file's name that is one anywhere: letters, digits, '-', '=' and, for runs of
/// anything else, '_'; at most 60 characters; "unnamed" where nothing is left.
std::string file_name_of(std::string_view text);

}  // namespace strandlab
