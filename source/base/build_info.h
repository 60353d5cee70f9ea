// What the program was built from, for --version and for the context of result files.
#pragma once

#include <string_view>

namespace strandlab {

/// How this library was built. All texts are never empty; "unknown" where something could not be told.
struct BuildInfo {
    std::string_view version;     ///< of the project: "0.1.0"
    std::string_view commit;      ///< full hash of the git commit; "unknown" outside a git checkout
    bool modified;                ///< the sources differ from that commit
    std::string_view compiler;    ///< "GNU 12.2.0"
    std::string_view flags;       ///< compiler options, those of the build type included
    std::string_view build_type;  ///< "Release"
};

const BuildInfo& build_info();

}  // namespace strandlab
