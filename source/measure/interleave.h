// Timing several things fairly: in rounds, in random order, so that drift hits all alike.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace strandlab {

/// What was measured of one thing; entry i is round i.
struct TimeSamples {
    std::vector<double> device_ms;    // what it says of itself
    std::vector<double> wall_ms;      // host clock around it
    std::vector<uint32_t> positions;  // its place in the round's order, from 0
};

struct InterleaveOptions {
    uint32_t rounds = 1;
    double warm_up_ms = 0;  // device time that all together spend before the first round: an idle GPU is slow
    uint64_t seed = 1;      // of the orders
    /// Asked after each round with the number of rounds done; true: enough. None: all rounds.
    std::function<bool(uint32_t done)> stop = {};
};

/// The order of a round: a permutation of 0 .. count - 1 drawn from seed and round alone.
std::vector<uint32_t> round_order(uint64_t seed, uint32_t round, uint32_t count);

/// Runs every trace (which returns its device time in milliseconds) once a round, after a warm-up in turns.
std::vector<TimeSamples> interleave(std::span<const std::function<double()>> traces,
                                    const InterleaveOptions& options);

}  // namespace strandlab
