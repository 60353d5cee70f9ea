// The sweep of levels of detail: `strandlab lod` and `bench --lod`.
#pragma once

#include "commands/arguments.h"

#include <cstdint>
#include <string>

namespace strandlab {

struct LodOptions {
    std::string model;  // FILE.hairmesh[,key=value,...]
    std::string resolution = "256x256", camera;
    std::string json, charts;  // file to append rows to; folder for an SVG of every primitive; empty: none
    PrimitiveArguments primitives;
    DeviceArguments device;
    double detail = 1, farthest = 32;  // L at distance 1; last distance, which doubles from 1
    uint32_t samples = 4, repeat = 3;
    uint64_t seed = 1;
};

/// Prints error, bytes and times of the model's levels of detail against all of it, at every distance on
/// every primitive (measure/lod_sweep.h). Throws Error (usage) for a model that is no hair mesh.
int run_lod(const LodOptions& options);

}  // namespace strandlab
