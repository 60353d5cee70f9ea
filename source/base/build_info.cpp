#include "base/build_info.h"

#include "base/version.h"

namespace strandlab {

const BuildInfo& build_info() {
    static constexpr BuildInfo info{
        .version = STRANDLAB_VERSION_TEXT,
        .commit = STRANDLAB_COMMIT,
        .modified = STRANDLAB_MODIFIED != 0,
        .compiler = STRANDLAB_COMPILER,
        .flags = STRANDLAB_COMPILER_FLAGS,
        .build_type = STRANDLAB_BUILD_TYPE,
    };
    return info;
}

}  // namespace strandlab
