// Tracing by ray queries: a compute shader (shaders/shared/query.glsl) in the place of a ray-tracing
// pipeline.
#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/trace_pipeline.h"

namespace strandlab {

class QueryPipeline : public TracePipeline {
  public:
    /// For a device that was opened with ray_query.
    QueryPipeline(const Device& device, std::span<const uint32_t> code, const PipelineConstants& constants,
                  uint32_t push_constant_bytes);

    double run(std::span<const Launch> launches) const override;
    std::vector<ShaderStatistic> statistics() const override { return pipeline_.statistics(); }

  private:
    ComputePipeline pipeline_;
};

}  // namespace strandlab
