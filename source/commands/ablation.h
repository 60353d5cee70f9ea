// bench --explain and --ablation: what tracing leaves out, and what each of that saves.
#pragma once

#include "commands/bench_options.h"

namespace strandlab {

/// For every model and primitive: which skips (trace/skips.h) are taken; for the first of all, what the time
/// from the program's start to its first ray was spent on. With `measure` each skip is also forced off, one
/// at a time, and so is our order of leaves; time and memory are set against all taken, interleaved, and the
/// hits compared. On a processor Embree's round curves are timed in the same rounds, and
/// processor time is counted beside the clock's.
void print_ablation(BenchOptions& options, bool measure);

}  // namespace strandlab
