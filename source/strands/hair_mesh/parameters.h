// What strands of a hair mesh can be asked for: how many, how styled, at which level of detail.
#pragma once

#include "base/parameters.h"

#include <string>
#include <vector>

namespace strandlab {

/// All parameters of "FILE.hairmesh,key=value,..."; lengths are metres, frequencies are per metre. A file
/// may set defaults of its own for all but those that is_of_caller names.
const std::vector<ParameterInfo>& hair_mesh_parameters();

/// Whether a parameter belongs to whoever asks for strands and cannot stand in a file: strands, seed, lod,
/// lod_points, lod_window.
bool is_of_caller(const std::string& key);

}  // namespace strandlab
