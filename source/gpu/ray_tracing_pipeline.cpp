#include "gpu/ray_tracing_pipeline.h"

#include "gpu/device_state.h"
#include "gpu/pipeline_statistics.h"
#include "gpu/specialization.h"
#include "gpu/timer.h"

#include <cstring>
#include <optional>

namespace strandlab {

struct RayTracingPipeline::Implementation {
    Device device;
    vk::raii::PipelineLayout layout{nullptr};
    vk::raii::Pipeline pipeline{nullptr};
    Buffer table;
    vk::StridedDeviceAddressRegionKHR ray_generation, miss, hit, callable;
    std::optional<Timer> timer;
};

namespace {

using Stage = vk::ShaderStageFlagBits;

/// Modules and stage infos in the order in which groups refer to them.
struct StageList {
    uint32_t add(const vk::raii::Device& device, Stage stage, std::span<const uint32_t> code,
                 const vk::SpecializationInfo& specialization) {
        if (code.empty()) return VK_SHADER_UNUSED_KHR;
        modules.emplace_back(device, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data()));
        infos.emplace_back(vk::PipelineShaderStageCreateFlags{}, stage, *modules.back(), "main",
                           &specialization);
        return static_cast<uint32_t>(infos.size()) - 1;
    }
    std::vector<vk::raii::ShaderModule> modules;
    std::vector<vk::PipelineShaderStageCreateInfo> infos;
};

constexpr uint32_t group_count = 3;  // ray generation, miss, hit

uint64_t round_up(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// One record per group, each at the base alignment: the table is tiny.
void make_table(const Device& device, RayTracingPipeline::Implementation& self) {
    const auto& limits = device.state().pipeline_limits;
    const uint64_t stride = round_up(limits.shaderGroupHandleSize, limits.shaderGroupBaseAlignment);
    const auto handles = self.pipeline.getRayTracingShaderGroupHandlesKHR<std::byte>(
        0, group_count, group_count * limits.shaderGroupHandleSize);
    self.table =
        Buffer(device, group_count * stride + limits.shaderGroupBaseAlignment, Buffer::Use::shader_records);
    const uint64_t base = round_up(self.table.address(), limits.shaderGroupBaseAlignment);
    std::vector<std::byte> bytes(self.table.size());
    vk::StridedDeviceAddressRegionKHR* regions[] = {&self.ray_generation, &self.miss, &self.hit};
    for (uint32_t i = 0; i < group_count; ++i) {
        std::memcpy(&bytes[base - self.table.address() + i * stride],
                    handles.data() + i * limits.shaderGroupHandleSize, limits.shaderGroupHandleSize);
        *regions[i] = vk::StridedDeviceAddressRegionKHR(base + i * stride, stride, stride);
    }
    self.table.upload(bytes);
}

}  // namespace

RayTracingPipeline::RayTracingPipeline(const Device& device, const PipelineStages& stages,
                                       const PipelineConstants& constants, uint32_t push_constant_bytes)
    : implementation_(std::make_unique<Implementation>(Implementation{device})) {
    guarded("making a ray-tracing pipeline", [&] {
        const DeviceState& state = device.state();
        Implementation& self = *implementation_;
        const Specialization specialization(constants);
        StageList list;
        const auto add = [&](Stage stage, std::span<const uint32_t> code) {
            return list.add(state.device, stage, code, specialization.info);
        };
        using Group = vk::RayTracingShaderGroupTypeKHR;
        const auto unused = VK_SHADER_UNUSED_KHR;
        std::vector<vk::RayTracingShaderGroupCreateInfoKHR> groups;
        groups.emplace_back(Group::eGeneral, add(Stage::eRaygenKHR, stages.ray_generation), unused, unused,
                            unused);
        groups.emplace_back(Group::eGeneral, add(Stage::eMissKHR, stages.miss), unused, unused, unused);
        const uint32_t closest = add(Stage::eClosestHitKHR, stages.closest_hit);
        const uint32_t any = add(Stage::eAnyHitKHR, stages.any_hit);
        const uint32_t intersection = add(Stage::eIntersectionKHR, stages.intersection);
        groups.emplace_back(
            stages.intersection.empty() ? Group::eTrianglesHitGroup : Group::eProceduralHitGroup, unused,
            closest, any, intersection);
        const vk::PushConstantRange range(Stage::eRaygenKHR | Stage::eMissKHR | Stage::eClosestHitKHR |
                                              Stage::eAnyHitKHR | Stage::eIntersectionKHR,
                                          0, push_constant_bytes);
        self.layout =
            vk::raii::PipelineLayout(state.device, vk::PipelineLayoutCreateInfo({}, nullptr, range));
        vk::RayTracingPipelineCreateInfoKHR info(statistics_flags(state), list.infos, groups, 1);
        info.layout = *self.layout;
        self.pipeline = vk::raii::Pipeline(state.device, nullptr, state.pipeline_cache, info);
        make_table(device, self);
        self.timer.emplace(state);
    });
}

RayTracingPipeline::RayTracingPipeline(RayTracingPipeline&&) noexcept = default;
RayTracingPipeline& RayTracingPipeline::operator=(RayTracingPipeline&&) noexcept = default;
RayTracingPipeline::~RayTracingPipeline() = default;

std::vector<ShaderStatistic> RayTracingPipeline::statistics() const {
    return statistics_of(implementation_->device.state(), *implementation_->pipeline);
}

double RayTracingPipeline::run(std::span<const Launch> launches) const {
    const Implementation& self = *implementation_;
    self.device.state().run("tracing", [&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eRayTracingKHR, *self.pipeline);
        self.timer->begin(commands);
        for (const Launch& launch : launches) {
            commands.pushConstants<std::byte>(*self.layout,
                                              Stage::eRaygenKHR | Stage::eMissKHR | Stage::eClosestHitKHR |
                                                  Stage::eAnyHitKHR | Stage::eIntersectionKHR,
                                              0, launch.push_constants);
            commands.traceRaysKHR(self.ray_generation, self.miss, self.hit, self.callable, launch.width,
                                  launch.height, 1);
        }
        self.timer->end(commands);
        full_barrier(commands);
    });
    return self.timer->milliseconds();
}

}  // namespace strandlab
