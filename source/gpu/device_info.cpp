// What a device can do.
#include "gpu/device_state.h"

#include <algorithm>
#include <cstring>

namespace strandlab {
namespace {

std::string version_text(uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string kind_of(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eCpu: return "cpu";
        case vk::PhysicalDeviceType::eDiscreteGpu: return "discrete";
        case vk::PhysicalDeviceType::eIntegratedGpu: return "integrated";
        case vk::PhysicalDeviceType::eVirtualGpu: return "virtual";
        default: return "other";
    }
}

/// Names of the extensions of `wanted` that the device lacks, and of features it does not offer.
std::string missing_parts(const vk::raii::PhysicalDevice& physical,
                          const std::vector<std::string>& extensions) {
    std::string missing;
    const auto add = [&](const std::string& name) { missing += (missing.empty() ? "" : ", ") + name; };
    if (physical.getProperties().apiVersion < VK_API_VERSION_1_2) add("Vulkan 1.2");
    bool all = true;
    for (const char* name :
         {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
          VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME}) {
        if (std::find(extensions.begin(), extensions.end(), name) != extensions.end()) continue;
        add(name);
        all = false;
    }
    if (!all || !missing.empty()) return missing;
    const auto features =
        physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                              vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                              vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>();
    if (!features.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress) add("bufferDeviceAddress");
    if (!features.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure)
        add("accelerationStructure");
    if (!features.get<vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>().rayTracingPipeline)
        add("rayTracingPipeline");
    return missing;
}

uint64_t largest_local_heap(const vk::PhysicalDeviceMemoryProperties& memory) {
    uint64_t largest = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            largest = std::max<uint64_t>(largest, memory.memoryHeaps[i].size);
    return largest;
}

}  // namespace

DeviceInfo describe(const vk::raii::PhysicalDevice& physical) {
    std::vector<std::string> extensions;
    for (const vk::ExtensionProperties& extension : physical.enumerateDeviceExtensionProperties())
        extensions.emplace_back(extension.extensionName.data());
    const auto has = [&](const char* name) {
        return std::find(extensions.begin(), extensions.end(), name) != extensions.end();
    };
    DeviceInfo info;
    const vk::PhysicalDeviceProperties basic = physical.getProperties();
    info.name = basic.deviceName.data();
    info.api_version = version_text(basic.apiVersion);
    info.kind = kind_of(basic.deviceType);
    info.missing = missing_parts(physical, extensions);
    info.timestamp_period =
        basic.limits.timestampComputeAndGraphics ? double(basic.limits.timestampPeriod) : 0.0;
    info.has_ray_query = has(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    info.has_ray_tracing_hardware = basic.deviceType != vk::PhysicalDeviceType::eCpu && info.has_ray_query;
    info.has_linear_swept_spheres = has("VK_NV_ray_tracing_linear_swept_spheres");
    info.memory = largest_local_heap(physical.getMemoryProperties());
    if (!info.is_usable()) return info;

    const auto chain =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                                vk::PhysicalDeviceMaintenance3Properties,
                                vk::PhysicalDeviceAccelerationStructurePropertiesKHR,
                                vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    info.driver = fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data());
    info.is_lavapipe = driver.driverID == vk::DriverId::eMesaLlvmpipe;
    info.max_allocation = chain.get<vk::PhysicalDeviceMaintenance3Properties>().maxMemoryAllocationSize;
    info.max_leaves = chain.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>().maxPrimitiveCount;
    info.max_launch =
        chain.get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>().maxRayDispatchInvocationCount;
    return info;
}

std::vector<DeviceInfo> list_devices() {
    const std::unique_ptr<InstanceState> instance = make_instance(false);
    return guarded("Vulkan", [&] {
        std::vector<DeviceInfo> devices;
        for (const vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance->instance))
            devices.push_back(describe(physical));
        return devices;
    });
}

}  // namespace strandlab
