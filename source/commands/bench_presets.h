// Sweeps with a name: what bench does where the command line does not say.
#pragma once

#include "commands/bench_options.h"
#include "gpu/device.h"

#include <string>

namespace strandlab {

/// The presets in one line each.
std::string preset_help();

/// Throws Error (usage) for a preset that there is not.
void check_preset(const std::string& name);

/// Fills in what the options leave open, for this device; says on standard error where a preset is scaled
/// down.
void apply_preset(BenchOptions& options, const DeviceInfo& device);

/// Device time that all primitives together spend before their first sample.
double warm_up_of(const DeviceInfo& device);

}  // namespace strandlab
