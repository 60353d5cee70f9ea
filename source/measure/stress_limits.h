// What each primitive must reach on each stress family, and whether it does.
#pragma once

#include "measure/stress.h"
#include "measure/stress_spawn.h"

#include <optional>
#include <string>
#include <string_view>

namespace strandlab {

/// Rates per decisive hit (false misses, wrong places) or decisive miss (false hits), and |dt| / r.
struct StressLimits {
    double false_miss = 0, false_hit = 0, wrong = 0;
    double p50 = 0, p99 = 0;
    std::string_view reason = {};  // why a rate is not 0, or why nothing is judged
    bool judged = true;
};

/// The documented figures of a primitive, whatever its variant: variants are held to what is known to be
/// possible, so that published ones fail where they are known to. precise: the double version, which has
/// the same rates and, of lss and rocaps, a p99 of 1e-10 radii. Nothing for primitives without figures.
std::optional<StressLimits> stress_limits(std::string_view primitive, const StressFamily& family,
                                          bool precise);

enum class StressVerdict { holds, fails, not_judged };

struct StressJudgement {
    StressVerdict verdict = StressVerdict::not_judged;
    std::string text;  // what is exceeded, or why nothing is judged; empty for a plain "holds"
};

/// Judges a tally. A rate is exceeded when its 95 % lower bound lies above the limit (so one error is
/// enough where the limit is 0); a percentile when the share of larger distances is, in the same way, too
/// large. No percentile is asked to be below the spacing of floats at t (precise: of doubles). NaN hits are
/// never allowed.
StressJudgement judge(const StressTally& tally, const std::optional<StressLimits>& limits,
                      const StressFamily& family, bool precise);

/// Whether a device agrees with the C++ float version: at most one hit in a thousand (its 95 % lower bound)
/// differs by more than max(4 ulp of t, 1e-4 r) or in hit or miss. Not judged where the text is not what
/// decides: triangles, which the driver intersects, published variants, whose frame rounds as a compiler
/// contracts it, and families that float cannot resolve.
StressJudgement judge_agreement(const Agreement& agreement, const PrimitiveChoice& choice,
                                const StressFamily& family);

/// Why the place of a hit is not known to a radius or better, whatever the intersector does: families that
/// float cannot resolve, and triangles at radii of 1e-4 lengths and less. Empty where it is.
std::string_view unknown_places(const Primitive& primitive, const StressFamily& family);

/// Whether rays leave a primitive's hits: no self-hit at its own offset, and no shadow ray whose hit or miss
/// is another than that of the closest hit. Not judged where places are unknown.
StressJudgement judge_spawned(const SpawnTally& tally, const Primitive& primitive,
                              const StressFamily& family);

/// Above this the surface is too small for its coordinates: the median margin of a resolvable cell.
inline constexpr double largest_stress_margin = 0.1;

}  // namespace strandlab
