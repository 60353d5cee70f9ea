// The kinds of stress runs besides errors against the oracle.
#pragma once

#include "measure/stress.h"
#include "trace/trace_device.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// What every kind of run is given.
struct StressRun {
    std::vector<const StressFamily*> families;
    std::vector<PrimitiveChoice> choices;
    std::vector<std::unique_ptr<TraceDevice>> devices;
    uint64_t pairs = 0, seed = default_stress_seed;  // pairs of each family
    std::vector<std::string> no_skips;               // on Vulkan devices
    std::string json;                                // file; empty: none
};

/// A device of a run, with the pipelines that it has made so far.
class StressDevice {
  public:
    StressDevice(const TraceDevice& device, const StressRun& run)
        : device_(&device), no_skips_(&run.no_skips) {}

    const std::string& name() const { return device_->name(); }
    bool is_gpu() const { return device_->gpu() != nullptr; }
    /// For a Vulkan device. extent: largest coordinate of any origin that will be traced.
    PairScene scene(const Primitive& primitive, const Geometry& geometry, const StressRange& range,
                    float extent);

  private:
    const TraceDevice* device_;
    const std::vector<std::string>* no_skips_;
    PipelineStore pipelines_;
};

/// Those of a run, which must outlive them.
std::vector<StressDevice> devices_of(const StressRun& run);

/// Pairs that are in memory at a time.
inline constexpr uint64_t stress_chunk_size = 20000;

/// The ranges of a family's pairs, one after the other.
std::vector<StressRange> stress_ranges(const StressFamily& family, uint64_t pairs, uint64_t seed);

/// A part of a family for one primitive: rays aimed at its surface, without answers.
struct StressChunk {
    const PrimitiveChoice& choice;
    const Curves& curves;
    Surface surface;
    Geometry geometry;
    StressPairs pairs;
};

/// Calls visit(family, choice, chunk) with indices into the run, for every part of every family, with a
/// progress line.
void for_each_chunk(const StressRun& run, const char* what,
                    const std::function<void(size_t, size_t, const StressChunk&)>& visit);

/// Rays that leave hits, as a table: exit code threshold when one meets the surface that it leaves, or when
/// traversal that may end early answers otherwise.
int run_self_intersection(const StressRun& run);

/// The boxes of leaves against hits that the intersectors find without them: exit code threshold when a box
/// loses one.
int run_watertight(const StressRun& run);

/// Vulkan devices against the C++ float version: exit code threshold when they differ by more than rounding.
int run_agreement(const StressRun& run);

}  // namespace strandlab
