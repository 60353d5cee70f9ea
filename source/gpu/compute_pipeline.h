// A compute shader with push constants: for small jobs beside tracing.
#pragma once

#include "gpu/device.h"
#include "gpu/ray_tracing_pipeline.h"

#include <cstdint>
#include <memory>
#include <span>

namespace strandlab {

class ComputePipeline {
  public:
    /// Compiles the shader with its specialization constants.
    ComputePipeline(const Device& device, std::span<const uint32_t> code, const PipelineConstants& constants,
                    uint32_t push_constant_bytes);
    ComputePipeline(ComputePipeline&&) noexcept;
    ComputePipeline& operator=(ComputePipeline&&) noexcept;
    ~ComputePipeline();

    /// Runs groups x 1 x 1 work groups and waits.
    void run(std::span<const std::byte> push_constants, uint32_t groups) const;

    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace strandlab
