// What traces rays on a device: launches with push constants, timed on the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace strandlab {

/// Specialization constants (id, bits), given to every stage; ids that a stage lacks are ignored.
using PipelineConstants = std::vector<std::pair<uint32_t, uint32_t>>;

/// A number that the driver tells of a compiled shader: registers, spills, instructions...
struct ShaderStatistic {
    std::string shader, name, value;
};

class TracePipeline {
  public:
    virtual ~TracePipeline() = default;

    /// One launch of width x height rays with its push constants.
    struct Launch {
        std::vector<std::byte> push_constants;
        uint32_t width = 0, height = 0;
        bool is_tiled = false;  // neighbours lie in both directions
    };

    /// Runs the launches one after another and waits; the device time around them in milliseconds.
    virtual double run(std::span<const Launch> launches) const = 0;
    /// Of a device that was opened with pipeline_statistics and whose driver tells; else none.
    virtual std::vector<ShaderStatistic> statistics() const = 0;
};

}  // namespace strandlab
