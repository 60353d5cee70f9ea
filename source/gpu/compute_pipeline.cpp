#include "gpu/compute_pipeline.h"

#include "gpu/device_state.h"
#include "gpu/pipeline_statistics.h"
#include "gpu/specialization.h"
#include "gpu/timer.h"

#include <optional>

namespace strandlab {

struct ComputePipeline::Implementation {
    Device device;
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
    std::optional<Timer> timer;
};

ComputePipeline::ComputePipeline(const Device& device, std::span<const uint32_t> code,
                                 const PipelineConstants& constants, uint32_t push_constant_bytes)
    : implementation_(std::make_unique<Implementation>(Implementation{device})) {
    guarded("making a compute pipeline", [&] {
        const DeviceState& state = device.state();
        Implementation& self = *implementation_;
        const Specialization specialization(constants);
        const vk::raii::ShaderModule module(state.device,
                                            vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
        const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, push_constant_bytes);
        self.layout =
            vk::raii::PipelineLayout(state.device, vk::PipelineLayoutCreateInfo({}, nullptr, range));
        const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                      &specialization.info);
        self.pipeline =
            vk::raii::Pipeline(state.device, state.pipeline_cache,
                               vk::ComputePipelineCreateInfo(statistics_flags(state), stage, *self.layout));
        self.timer.emplace(state);
    });
}

ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;
ComputePipeline::~ComputePipeline() = default;

double ComputePipeline::run(std::span<const Dispatch> dispatches) const {
    const Implementation& self = *implementation_;
    self.device.state().run("computing", [&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *self.pipeline);
        self.timer->begin(commands);
        for (const Dispatch& dispatch : dispatches) {
            commands.pushConstants<std::byte>(
                *self.layout, vk::ShaderStageFlagBits::eCompute, 0,
                {static_cast<uint32_t>(dispatch.push_constants.size()), dispatch.push_constants.data()});
            commands.dispatch(dispatch.columns, dispatch.rows, 1);
        }
        self.timer->end(commands);
        full_barrier(commands);
    });
    return self.timer->milliseconds();
}

std::vector<ShaderStatistic> ComputePipeline::statistics() const {
    return statistics_of(implementation_->device.state(), *implementation_->pipeline);
}

}  // namespace strandlab
