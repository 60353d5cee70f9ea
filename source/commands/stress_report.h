// What strandlab stress prints and writes.
#pragma once

#include "measure/stress.h"
#include "measure/stress_limits.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <string_view>

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

/// "holds", "FAILS" or "not judged".
std::string_view verdict_text(StressVerdict verdict);

/// A device's name without what follows in brackets.
std::string device_text(const std::string& name);

/// Two digits of a quantile; "-" of nothing.
std::string quantile_text(const LogHistogram& values, double q);

/// "mean / p99 / max" of the iterations per ray; "-" without any.
std::string iterations_text(const IterationHistogram& iterations);

/// A count with the number of trials and the 95 % bounds of its rate.
nlohmann::ordered_json rate_json(uint64_t count, uint64_t trials);

/// The families with one line each, for the help.
std::string stress_family_help();

/// A row a cell.
std::string stress_table(std::span<const StressCell> cells);

/// A few lines: how many cells hold, every failure with its bounds, what the boxes lost.
std::string stress_summary(std::span<const StressCell> cells);

/// One JSON object a line and cell.
std::string stress_json(std::span<const StressCell> cells, uint64_t seed,
                        std::span<const std::string> no_skips);

/// Family x primitive and device as an SVG picture: the shade is the rate of errors, the colour the verdict.
std::string stress_heat_map(std::span<const StressCell> cells);

/// Writes the worst pairs of a cell into a folder, each as two files that `strandlab trace` replays:
/// FAMILY.PRIMITIVE.DEVICE.INDEX.curves.npy and .rays.npy.
void write_worst(const StressCell& cell, uint64_t seed, const std::string& folder);

}  // namespace strandlab
