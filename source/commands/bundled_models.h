// The models that come with the program.
#pragma once

#include <string>
#include <vector>

namespace strandlab {

/// Files of the models folder beside the program's sources or below its installation, by name; Error
/// (bad_input) when there is none. STRANDLAB_MODELS names another folder.
std::vector<std::string> bundled_models();

}  // namespace strandlab
