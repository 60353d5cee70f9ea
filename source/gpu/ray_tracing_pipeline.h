// A ray-tracing pipeline with one hit group, its shader binding table, and timed launches.
#pragma once

#include "gpu/device.h"
#include "gpu/trace_pipeline.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace strandlab {

/// SPIR-V of the stages; intersection and any_hit may be empty (then the hit group is of triangles, or
/// has no any-hit shader).
struct PipelineStages {
    std::span<const uint32_t> ray_generation, miss, closest_hit, intersection, any_hit;
};

class RayTracingPipeline : public TracePipeline {
  public:
    /// Compiles the stages; push_constant_bytes is the size of the block that all stages share.
    RayTracingPipeline(const Device& device, const PipelineStages& stages, const PipelineConstants& constants,
                       uint32_t push_constant_bytes);
    RayTracingPipeline(RayTracingPipeline&&) noexcept;
    RayTracingPipeline& operator=(RayTracingPipeline&&) noexcept;
    ~RayTracingPipeline() override;

    double run(std::span<const Launch> launches) const override;
    std::vector<ShaderStatistic> statistics() const override;

    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace strandlab
