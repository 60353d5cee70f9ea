// Hair made from numbers: "generate:NAME,key=value,..." stands wherever a model file is named.
#pragma once

#include "base/parameters.h"
#include "strands/curves.h"
#include "strands/strands.h"

#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// One generator.
struct Generator {
    std::string name;
    std::string summary;  // one line for help
    std::vector<ParameterInfo> parameters;
    Curves (*make)(const Parameters& parameters);
};

/// All generators, in the order of help. Lengths are metres; y is up, faces look to +z.
const std::vector<Generator>& generators();

/// Whether a model name is a specification rather than a file.
bool is_generator_spec(std::string_view model);

/// Makes the curves of a specification. The result depends on its parameters alone, to the last bit: not
/// on the machine or the number of threads. Throws Error (usage) that names generator, key and value.
Curves generate(std::string_view spec);

}  // namespace strandlab
