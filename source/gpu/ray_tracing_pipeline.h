// A ray-tracing pipeline with one hit group, its shader binding table, and timed launches.
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace strandlab {

/// SPIR-V of the stages; intersection and any_hit may be empty (then the hit group is of triangles, or
/// has no any-hit shader).
struct PipelineStages {
    std::span<const uint32_t> ray_generation, miss, closest_hit, intersection, any_hit;
};

/// Specialization constants (id, bits), given to every stage; ids that a stage lacks are ignored.
using PipelineConstants = std::vector<std::pair<uint32_t, uint32_t>>;

class RayTracingPipeline {
  public:
    /// Compiles the stages; push_constant_bytes is the size of the block that all stages share.
    RayTracingPipeline(const Device& device, const PipelineStages& stages, const PipelineConstants& constants,
                       uint32_t push_constant_bytes);
    RayTracingPipeline(RayTracingPipeline&&) noexcept;
    RayTracingPipeline& operator=(RayTracingPipeline&&) noexcept;
    ~RayTracingPipeline();

    /// One launch of width x height rays with its push constants.
    struct Launch {
        std::vector<std::byte> push_constants;
        uint32_t width = 0, height = 0;
    };

    /// Runs the launches one after another and waits; the device time around them in milliseconds.
    double run(std::span<const Launch> launches) const;

    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace strandlab
