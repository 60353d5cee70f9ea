// What a driver tells of the shaders that it compiled (VK_KHR_pipeline_executable_properties). Only this
// folder sees it.
#pragma once

#include "gpu/device_state.h"
#include "gpu/trace_pipeline.h"

namespace strandlab {

/// Flags of a pipeline that will be asked for its statistics; none on a device opened without them.
vk::PipelineCreateFlags statistics_flags(const DeviceState& state);

/// Empty on a device opened without them.
std::vector<ShaderStatistic> statistics_of(const DeviceState& state, vk::Pipeline pipeline);

}  // namespace strandlab
