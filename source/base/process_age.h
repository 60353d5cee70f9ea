// How long the program has been running.
#pragma once

namespace strandlab {

/// Milliseconds since the process was started, its loading included, in steps of about 10; 0 where the system
/// does not tell.
double process_age_ms();

}  // namespace strandlab
