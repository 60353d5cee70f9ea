// Choosing and opening a device.
#include "base/cache.h"
#include "base/hash.h"
#include "base/text.h"
#include "gpu/device_state.h"

#include <algorithm>
#include <cctype>

namespace strandlab {
namespace {

int rank_of(const DeviceInfo& info) {
    constexpr const char* order[] = {"cpu", "other", "virtual", "integrated", "discrete"};
    const auto* const place = std::find(std::begin(order), std::end(order), info.kind);
    return info.is_usable() ? 1 + static_cast<int>(place - std::begin(order)) : 0;
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool matches(const DeviceInfo& info, size_t index, const std::string& selector) {
    if (const auto number = to_number(selector)) return double(index) == *number;
    return info.kind == selector || lower(info.name).find(lower(selector)) != std::string::npos ||
           (info.is_lavapipe && lower(selector) == "lavapipe");
}

/// Index of the best device that the selector allows.
size_t choose(const std::vector<DeviceInfo>& devices, const std::string& selector) {
    size_t best = devices.size();
    std::string seen;
    for (size_t i = 0; i < devices.size(); ++i) {
        seen += fmt::format("{}{} ({})", seen.empty() ? "" : ", ", devices[i].name,
                            devices[i].is_usable() ? devices[i].kind : "lacks " + devices[i].missing);
        if (!selector.empty() && !matches(devices[i], i, selector)) continue;
        if (best == devices.size() || rank_of(devices[i]) > rank_of(devices[best])) best = i;
    }
    if (best == devices.size())
        fail(ExitCode::no_device, "--device {}: no such Vulkan device; there {}",
             selector.empty() ? "auto" : selector,
             seen.empty() ? "is none: run tools/setup for Mesa's lavapipe" : "are " + seen);
    if (!devices[best].is_usable())
        fail(ExitCode::no_device,
             "--device {}: {} lacks {}; run tools/setup for a lavapipe with ray tracing, or choose another "
             "device",
             selector.empty() ? "auto" : selector, devices[best].name, devices[best].missing);
    return best;
}

uint32_t compute_family(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    for (uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & vk::QueueFlagBits::eCompute) && families[i].timestampValidBits > 0)
            return i;
    fail(ExitCode::no_device, "{}: no compute queue with timestamps",
         physical.getProperties().deviceName.data());
}

bool has_extension(const vk::raii::PhysicalDevice& physical, std::string_view name) {
    const auto all = physical.enumerateDeviceExtensionProperties();
    return std::any_of(all.begin(), all.end(), [&](const vk::ExtensionProperties& extension) {
        return name == extension.extensionName.data();
    });
}

/// Opens the device with what the state says is enabled beyond the necessary.
vk::raii::Device open_device(const DeviceState& state) {
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, state.queue_family, 1, &priority);
    std::vector<const char*> extensions = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                           VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME,
                                           VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    if (state.has_ray_query) extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    if (state.has_pipeline_statistics)
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceVulkan12Features,
                       vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceRayTracingPipelineFeaturesKHR, vk::PhysicalDeviceRayQueryFeaturesKHR,
                       vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>
        chain;
    chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue).setPEnabledExtensionNames(extensions);
    chain.get<vk::PhysicalDeviceVulkan12Features>().bufferDeviceAddress = true;
    chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure = true;
    chain.get<vk::PhysicalDeviceRayTracingPipelineFeaturesKHR>().rayTracingPipeline = true;
    chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery = true;
    chain.get<vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>().pipelineExecutableInfo = true;
    if (!state.has_ray_query) chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    if (!state.has_pipeline_statistics)
        chain.unlink<vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>();
    return {state.physical, chain.get<vk::DeviceCreateInfo>()};
}

/// Compiled shaders of earlier runs on this device and driver. Drivers check what they are given, and the
/// cache that it came whole.
void open_pipeline_cache(DeviceState& state) {
    const vk::PhysicalDeviceProperties basic = state.physical.getProperties();
    Hash device;
    device.add(basic.pipelineCacheUUID.data(), basic.pipelineCacheUUID.size());
    state.pipeline_cache_key =
        fmt::format("pipelines/1 vendor={} device={} driver={} uuid={:016x}", basic.vendorID, basic.deviceID,
                    basic.driverVersion, device.value());
    const std::vector<std::byte> bytes =
        cache_read(state.pipeline_cache_key).value_or(std::vector<std::byte>());
    state.pipeline_cache_hash = Hash().add(bytes.data(), bytes.size()).value();
    state.pipeline_cache =
        vk::raii::PipelineCache(state.device, vk::PipelineCacheCreateInfo({}, bytes.size(), bytes.data()));
}

}  // namespace

uint32_t DeviceState::memory_type(uint32_t allowed,
                                  std::initializer_list<vk::MemoryPropertyFlags> wanted) const {
    for (const vk::MemoryPropertyFlags flags : wanted)
        for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
            if ((allowed & (1u << i)) && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    fail(ExitCode::no_device, "{}: no memory of the kind that is needed", info.name);
}

DeviceState::~DeviceState() {
    if (!*pipeline_cache) return;
    try {
        const std::vector<uint8_t> data = pipeline_cache.getData();
        const auto bytes = std::as_bytes(std::span(data));
        // Drivers that keep their own files (Mesa) give a header alone.
        constexpr size_t header_bytes = 32;
        if (bytes.size() > header_bytes &&
            Hash().add(bytes.data(), bytes.size()).value() != pipeline_cache_hash)
            cache_write(pipeline_cache_key, bytes);
    } catch (const std::exception&) {
        // A cache that could not be kept is the same as none.
    }
}

Device::Device(const DeviceOptions& options) : state_(std::make_shared<DeviceState>()) {
    DeviceState& s = *state_;
    s.validation = options.validation;
    s.instance = make_instance(options.validation);
    guarded("Vulkan", [&] {
        vk::raii::PhysicalDevices all(s.instance->instance);
        std::vector<DeviceInfo> infos;
        for (const vk::raii::PhysicalDevice& physical : all) infos.push_back(describe(physical));
        const size_t chosen = choose(infos, options.selector);
        s.physical = std::move(all[chosen]);
        s.info = infos[chosen];
        s.queue_family = compute_family(s.physical);
        s.has_ray_query = options.ray_query && s.info.has_ray_query;
        s.has_pipeline_statistics =
            options.pipeline_statistics &&
            has_extension(s.physical, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        s.device = open_device(s);
        open_pipeline_cache(s);
        s.queue = s.device.getQueue(s.queue_family, 0);
        s.pool = vk::raii::CommandPool(s.device, {vk::CommandPoolCreateFlagBits::eTransient, s.queue_family});
        s.memory = s.physical.getMemoryProperties();
        const auto limits = s.physical.getProperties2<vk::PhysicalDeviceProperties2,
                                                      vk::PhysicalDeviceAccelerationStructurePropertiesKHR,
                                                      vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
        s.structure_limits = limits.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
        s.pipeline_limits = limits.get<vk::PhysicalDeviceRayTracingPipelinePropertiesKHR>();
        s.structure_limits.pNext = s.pipeline_limits.pNext = nullptr;
    });
}

const DeviceInfo& Device::info() const { return state_->info; }

bool Device::can_query_rays() const { return state_->has_ray_query; }

bool Device::has_validation() const { return state_->validation; }

std::vector<std::string> Device::validation_messages() const {
    MessageLog& log = *state_->instance->log;
    const std::lock_guard lock(log.mutex);
    return log.messages;
}

}  // namespace strandlab
