// The intersectors and the oracle, on whatever rays and curves.
#pragma once

#include "fuzz/fuzz_target.h"

namespace strandlab::fuzz {

FuzzTarget dots_target();
FuzzTarget lss_target();
FuzzTarget prhi_target();
FuzzTarget rocaps_target();
FuzzTarget oracle_target();

}  // namespace strandlab::fuzz
