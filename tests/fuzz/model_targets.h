// Readers of hair models.
#pragma once

#include "fuzz/fuzz_target.h"

namespace strandlab::fuzz {

FuzzTarget hair_target();
FuzzTarget hairmesh_target();
FuzzTarget tfx_target();
FuzzTarget data_target();
FuzzTarget npy_target();
FuzzTarget npy_strands_target();

}  // namespace strandlab::fuzz
