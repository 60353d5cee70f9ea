// What an opened device consists of. Only this folder sees it.
#pragma once

#include "base/error.h"
#include "gpu/device.h"
#include "gpu/vulkan.h"

#include <mutex>
#include <optional>

namespace strandlab {

/// Turns Vulkan's exceptions into the program's: lost device and exhausted memory have their own code.
template <class Body>
auto guarded(const char* what, Body&& body) {
    try {
        return body();
    } catch (const vk::DeviceLostError& error) {
        fail(ExitCode::device_lost, "{}: the device was lost ({}); try fewer rays a launch or another device",
             what, error.what());
    } catch (const vk::OutOfDeviceMemoryError&) {
        throw OutOfMemory(ExitCode::device_lost,
                          fmt::format("{}: out of device memory; try a smaller model or fewer leaves", what));
    } catch (const vk::OutOfHostMemoryError&) {
        throw OutOfMemory(ExitCode::device_lost,
                          fmt::format("{}: out of host memory; try a smaller model or fewer leaves", what));
    } catch (const vk::SystemError& error) {
        fail(ExitCode::no_device, "{}: {}", what, error.what());
    }
}

/// Messages of the validation layers, collected from any thread.
struct MessageLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

/// A Vulkan instance with or without validation layers.
struct InstanceState {
    explicit InstanceState(bool validation);

    vk::raii::Context context;
    std::shared_ptr<MessageLog> log = std::make_shared<MessageLog>();
    vk::raii::Instance instance{nullptr};
    vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
};

/// Opens the loader; Error (no_device) with what to install when there is none.
std::unique_ptr<InstanceState> make_instance(bool validation);

DeviceInfo describe(const vk::raii::PhysicalDevice& physical);

struct DeviceState {
    DeviceState() = default;
    DeviceState(const DeviceState&) = delete;
    DeviceState& operator=(const DeviceState&) = delete;
    ~DeviceState();

    std::unique_ptr<InstanceState> instance;
    vk::raii::PhysicalDevice physical{nullptr};
    DeviceInfo info;
    bool validation = false;
    bool has_ray_query = false;            // enabled
    bool has_pipeline_statistics = false;  // enabled
    uint32_t queue_family = 0;
    vk::raii::Device device{nullptr};
    vk::raii::Queue queue{nullptr};
    vk::raii::CommandPool pool{nullptr};
    vk::raii::PipelineCache pipeline_cache{nullptr};
    std::string pipeline_cache_key;    // of base/cache.h
    uint64_t pipeline_cache_hash = 0;  // of what was read
    vk::PhysicalDeviceMemoryProperties memory;
    vk::PhysicalDeviceAccelerationStructurePropertiesKHR structure_limits;
    vk::PhysicalDeviceRayTracingPipelinePropertiesKHR pipeline_limits;

    /// Index of a memory type with all wanted properties; the first of the lists that exists.
    uint32_t memory_type(uint32_t allowed, std::initializer_list<vk::MemoryPropertyFlags> wanted) const;

    /// Records commands, submits them, waits until they are done.
    template <class Record>
    void run(const char* what, Record&& record) const {
        guarded(what, [&] {
            const vk::raii::CommandBuffers buffers(device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
            const vk::raii::CommandBuffer& commands = buffers.front();
            commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
            record(commands);
            commands.end();
            const vk::raii::Fence fence(device, vk::FenceCreateInfo{});
            queue.submit(vk::SubmitInfo(nullptr, nullptr, *commands), *fence);
            while (device.waitForFences(*fence, true, UINT64_MAX) == vk::Result::eTimeout) {
            }
        });
    }
};

struct Buffer::Implementation {
    Device device;  // keeps it open
    vk::raii::Buffer buffer{nullptr};
    vk::raii::DeviceMemory memory{nullptr};
    size_t bytes = 0;
    uint64_t address = 0;
    void* mapped = nullptr;  // when the host can reach the memory
};

/// The Vulkan handle of a buffer.
inline vk::Buffer handle_of(const Buffer& buffer) { return *buffer.implementation().buffer; }

/// Makes everything written before visible to everything after: builds and copies are few.
void full_barrier(const vk::raii::CommandBuffer& commands);

}  // namespace strandlab
