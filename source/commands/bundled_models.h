// The models that come with the program.
#pragma once

#include <string>
#include <vector>

namespace strandlab {

/// The hair meshes of the models folder beside the program's sources or below its installation, by name, each
/// with a few hundred thick strands; its .hair files when it has none. Error (bad_input) when there is
/// neither. STRANDLAB_MODELS names another folder.
std::vector<std::string> bundled_models();

}  // namespace strandlab
