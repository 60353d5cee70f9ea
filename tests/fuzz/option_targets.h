// Readers of option texts.
#pragma once

#include "fuzz/fuzz_target.h"

namespace strandlab::fuzz {

FuzzTarget camera_target();
FuzzTarget generator_target();
FuzzTarget options_target();  // primitives, resolutions, names of ray sets, numbers, lines of messages

}  // namespace strandlab::fuzz
