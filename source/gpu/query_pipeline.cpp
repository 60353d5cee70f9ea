#include "gpu/query_pipeline.h"

namespace strandlab {

QueryPipeline::QueryPipeline(const Device& device, std::span<const uint32_t> code,
                             const PipelineConstants& constants, uint32_t push_constant_bytes)
    : pipeline_(device, code, constants, push_constant_bytes) {}

double QueryPipeline::run(std::span<const Launch> launches) const {
    std::vector<ComputePipeline::Dispatch> dispatches;
    for (const Launch& launch : launches) {
        // The shapes of a work group in the shader.
        const uint32_t columns = launch.is_tiled ? 8 : 64, rows = launch.is_tiled ? 8 : 1;
        dispatches.push_back({launch.push_constants, (launch.width + columns - 1) / columns,
                              (launch.height + rows - 1) / rows});
    }
    return pipeline_.run(dispatches);
}

}  // namespace strandlab
