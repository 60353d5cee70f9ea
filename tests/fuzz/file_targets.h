// Readers of what programs exchange: rays, hits, scenes, result rows, cache entries.
#pragma once

#include "fuzz/fuzz_target.h"

namespace strandlab::fuzz {

FuzzTarget rays_target();
FuzzTarget hits_target();
FuzzTarget scene_target();
FuzzTarget rows_target();
FuzzTarget cache_target();

}  // namespace strandlab::fuzz
