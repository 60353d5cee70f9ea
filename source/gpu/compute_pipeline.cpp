#include "gpu/compute_pipeline.h"

#include "gpu/device_state.h"
#include "gpu/specialization.h"

namespace strandlab {

struct ComputePipeline::Implementation {
    Device device;
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
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
            vk::raii::Pipeline(state.device, nullptr, vk::ComputePipelineCreateInfo({}, stage, *self.layout));
    });
}

ComputePipeline::ComputePipeline(ComputePipeline&&) noexcept = default;
ComputePipeline& ComputePipeline::operator=(ComputePipeline&&) noexcept = default;
ComputePipeline::~ComputePipeline() = default;

void ComputePipeline::run(std::span<const std::byte> push_constants, uint32_t groups) const {
    const Implementation& self = *implementation_;
    self.device.state().run("computing", [&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *self.pipeline);
        commands.pushConstants<std::byte>(
            *self.layout, vk::ShaderStageFlagBits::eCompute, 0,
            {static_cast<uint32_t>(push_constants.size()), push_constants.data()});
        commands.dispatch(groups, 1, 1);
        full_barrier(commands);
    });
}

}  // namespace strandlab
