#include "measure/interleave.h"

#include "base/random.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <numeric>

namespace strandlab {
namespace {

constexpr uint64_t stream_order = 0x6F72646572;  // "order"

/// Until so much device time has gone; at most ten times as long by the wall, for devices whose clock does
/// not tell.
void warm_up(std::span<const std::function<double()>> traces, double device_ms) {
    if (traces.empty()) return;
    const Stopwatch wall;
    double spent = 0;
    for (size_t i = 0; spent < device_ms && wall.milliseconds() < 10 * device_ms; ++i)
        spent += traces[i % traces.size()]();
}

}  // namespace

std::vector<uint32_t> round_order(uint64_t seed, uint32_t round, uint32_t count) {
    std::vector<uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    Random random(seed, stream_order, round);
    for (uint32_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
}

std::vector<TimeSamples> interleave(std::span<const std::function<double()>> traces,
                                    const InterleaveOptions& options) {
    warm_up(traces, options.warm_up_ms);
    std::vector<TimeSamples> samples(traces.size());
    for (uint32_t round = 0; round < options.rounds; ++round) {
        const auto order = round_order(options.seed, round, static_cast<uint32_t>(traces.size()));
        for (uint32_t position = 0; position < order.size(); ++position) {
            TimeSamples& of_trace = samples[order[position]];
            const Stopwatch wall;
            of_trace.device_ms.push_back(traces[order[position]]());
            of_trace.wall_ms.push_back(wall.milliseconds());
            of_trace.positions.push_back(position);
        }
        if (options.stop && options.stop(round + 1)) break;
    }
    return samples;
}

}  // namespace strandlab
