// A compute shader with push constants: for small jobs beside tracing, and for tracing by ray queries.
#pragma once

#include "gpu/device.h"
#include "gpu/trace_pipeline.h"

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

    /// columns x rows x 1 work groups with their push constants.
    struct Dispatch {
        std::span<const std::byte> push_constants;
        uint32_t columns = 1, rows = 1;
    };

    /// Runs one after another and waits; the device time around them in milliseconds.
    double run(std::span<const Dispatch> dispatches) const;
    std::vector<ShaderStatistic> statistics() const;

    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace strandlab
