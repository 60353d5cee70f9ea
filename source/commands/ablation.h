// bench --explain and --ablation: what tracing leaves out, and what each of that saves.
#pragma once

#include "commands/bench_options.h"

namespace strandlab {

/// For every model and primitive: which skips (trace/skips.h) are taken. With `measure` each of them is also
/// forced off, one at a time; time and memory are set against all taken, interleaved, and the hits compared.
void print_ablation(BenchOptions& options, bool measure);

}  // namespace strandlab
