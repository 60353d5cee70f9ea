#include "gpu/pipeline_statistics.h"

#include <fmt/format.h>

namespace strandlab {
namespace {

std::string text_of(const vk::PipelineExecutableStatisticKHR& statistic) {
    using Format = vk::PipelineExecutableStatisticFormatKHR;
    switch (statistic.format) {
        case Format::eBool32: return statistic.value.b32 ? "yes" : "no";
        case Format::eInt64: return fmt::format("{}", statistic.value.i64);
        case Format::eUint64: return fmt::format("{}", statistic.value.u64);
        case Format::eFloat64: return fmt::format("{:.4g}", statistic.value.f64);
    }
    return "?";
}

}  // namespace

vk::PipelineCreateFlags statistics_flags(const DeviceState& state) {
    if (!state.has_pipeline_statistics) return {};
    return vk::PipelineCreateFlagBits::eCaptureStatisticsKHR;
}

std::vector<ShaderStatistic> statistics_of(const DeviceState& state, vk::Pipeline pipeline) {
    if (!state.has_pipeline_statistics) return {};
    return guarded("asking for shader statistics", [&] {
        std::vector<ShaderStatistic> all;
        const auto executables = state.device.getPipelineExecutablePropertiesKHR({pipeline});
        for (uint32_t i = 0; i < executables.size(); ++i)
            for (const auto& statistic : state.device.getPipelineExecutableStatisticsKHR({pipeline, i}))
                all.push_back({executables[i].name.data(), statistic.name.data(), text_of(statistic)});
        return all;
    });
}

}  // namespace strandlab
