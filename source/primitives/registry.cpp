// All primitives, one line each, in the order in which reports list them.
#include "primitives/dots.h"
#include "primitives/lss.h"
#include "primitives/null_primitive.h"
#include "primitives/prhi.h"
#include "primitives/primitive.h"
#include "primitives/rocaps.h"

#include <array>

namespace strandlab {

std::span<const Primitive> primitives() {
    static const std::array all = {
        dots(), lss(), prhi(), rocaps(), null_primitive(),
    };
    return all;
}

}  // namespace strandlab
