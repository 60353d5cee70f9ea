// All primitives, one line each, in the order in which reports list them.
#include "primitives/lss.h"
#include "primitives/primitive.h"
#include "primitives/rocaps.h"
#include "primitives/prhi.h"

#include <array>

namespace strandlab {

std::span<const Primitive> primitives() {
    static const std::array all = {
        lss(),
        rocaps(),
        prhi(),
    };
    return all;
}

}  // namespace strandlab
