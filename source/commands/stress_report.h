// What strandlab stress prints and writes.
#pragma once

#include "measure/stress.h"
#include "measure/stress_limits.h"

#include <span>
#include <string>

namespace strandlab {

/// One primitive on one device over one family.
struct StressCell {
    const StressFamily* family = nullptr;
    const Primitive* primitive = nullptr;  // none: Embree
    std::string label;                     // of the primitive with its options
    std::string device;                    // its name
    bool precise = false;
    StressTally tally;
    StressJudgement judgement;
};

/// The families with one line each, for the help.
std::string stress_family_help();

/// A row a cell.
std::string stress_table(std::span<const StressCell> cells);

/// A few lines: how many cells hold, every failure with its bounds, what the boxes lost.
std::string stress_summary(std::span<const StressCell> cells);

/// One JSON object a line and cell.
std::string stress_json(std::span<const StressCell> cells, uint64_t seed);

/// Family x primitive and device as an SVG picture: the shade is the rate of errors, the colour the verdict.
std::string stress_heat_map(std::span<const StressCell> cells);

/// Writes the worst pairs of a cell into a folder, each as two files that `strandlab trace` replays:
/// FAMILY.PRIMITIVE.DEVICE.INDEX.curves.npy and .rays.npy.
void write_worst(const StressCell& cell, uint64_t seed, const std::string& folder);

}  // namespace strandlab
