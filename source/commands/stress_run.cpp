#include "commands/stress_run.h"

#include "base/progress.h"

#include <algorithm>

namespace strandlab {

PairScene StressDevice::scene(const Primitive& primitive, const Geometry& geometry, const StressRange& range,
                              float extent) {
    return PairScene(*device_->gpu(), primitive, geometry, range,
                     {extent, &pipelines_, device_->arithmetic(), *no_skips_});
}

std::vector<StressDevice> devices_of(const StressRun& run) {
    std::vector<StressDevice> devices;
    for (const auto& device : run.devices) devices.emplace_back(*device, run);
    return devices;
}

std::vector<StressRange> stress_ranges(const StressFamily& family, uint64_t pairs, uint64_t seed) {
    std::vector<StressRange> ranges;
    for (uint64_t first = 0; first < pairs; first += stress_chunk_size)
        ranges.push_back({&family, seed, first, std::min(stress_chunk_size, pairs - first)});
    return ranges;
}

void for_each_chunk(const StressRun& run, const char* what,
                    const std::function<void(size_t, size_t, const StressChunk&)>& visit) {
    Progress progress(what, run.pairs * run.families.size() * run.choices.size());
    for (size_t f = 0; f < run.families.size(); ++f)
        for (const StressRange& range : stress_ranges(*run.families[f], run.pairs, run.seed)) {
            const Curves curves = stress_strands(range);
            for (size_t c = 0; c < run.choices.size(); ++c) {
                const PrimitiveChoice& choice = run.choices[c];
                Surface surface = choice.primitive->surface(curves, choice.options);
                StressPairs pairs = aimed_pairs(range, surface);
                const StressChunk chunk{choice, curves, std::move(surface),
                                        choice.primitive->build(curves, choice.options), std::move(pairs)};
                visit(f, c, chunk);
                progress.tick(range.count);
            }
        }
}

}  // namespace strandlab
