// All targets, one line each.
#include "fuzz/file_targets.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/intersector_targets.h"
#include "fuzz/model_targets.h"
#include "fuzz/option_targets.h"

#include <array>

namespace strandlab::fuzz {

std::span<const FuzzTarget> fuzz_targets() {
    static const std::array all = {
        hair_target(),        hairmesh_target(), tfx_target(),       data_target(),    npy_target(),
        npy_strands_target(), rays_target(),     hits_target(),      scene_target(),   rows_target(),
        cache_target(),       camera_target(),   generator_target(), options_target(), dots_target(),
        lss_target(),         prhi_target(),     rocaps_target(),    oracle_target(),
    };
    return all;
}

}  // namespace strandlab::fuzz
