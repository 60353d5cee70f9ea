// Leaves for as much memory as there is.
#pragma once

#include "measure/bench_case.h"

namespace strandlab {

/// The choice with as many leaves as keep what stays on the device while tracing (structures and records)
/// within bytes_per_curve for each curve of the scene, by what builds on the device take. Primitives without
/// the parameter "splits" stay as they are. Throws Error (usage) when not even the fewest leaves fit, or the
/// device has no acceleration structures.
PrimitiveChoice within_memory(const CaseInput& input, const PrimitiveChoice& choice, double bytes_per_curve);

}  // namespace strandlab
