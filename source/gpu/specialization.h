// Specialization constants as Vulkan takes them. Only this folder sees it.
#pragma once

#include "gpu/ray_tracing_pipeline.h"
#include "gpu/vulkan.h"

#include <vector>

namespace strandlab {

/// Constants for any number of stages; ids that a stage lacks are ignored. Must outlive the creation.
struct Specialization {
    explicit Specialization(const PipelineConstants& constants) {
        for (const auto& [id, bits] : constants) {
            entries.emplace_back(id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)),
                                 sizeof(uint32_t));
            values.push_back(bits);
        }
        info.setMapEntries(entries).setData<uint32_t>(values);
    }
    Specialization(const Specialization&) = delete;
    Specialization& operator=(const Specialization&) = delete;

    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    vk::SpecializationInfo info;
};

}  // namespace strandlab
