// Buffers: one allocation each (there are few and large ones), uploads and downloads.
#include "gpu/device_state.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace strandlab {
namespace {

using Flags = vk::BufferUsageFlagBits;
using Memory = vk::MemoryPropertyFlagBits;

constexpr size_t staging_bytes = size_t(64) << 20;

vk::BufferUsageFlags usage_of(Buffer::Use use) {
    const vk::BufferUsageFlags common =
        Flags::eShaderDeviceAddress | Flags::eTransferDst | Flags::eTransferSrc;
    switch (use) {
        case Buffer::Use::storage:
        case Buffer::Use::scratch: return common | Flags::eStorageBuffer;
        case Buffer::Use::build_input: return common | Flags::eAccelerationStructureBuildInputReadOnlyKHR;
        case Buffer::Use::structure: return common | Flags::eAccelerationStructureStorageKHR;
        case Buffer::Use::shader_records: return common | Flags::eShaderBindingTableKHR;
        case Buffer::Use::download: return Flags::eTransferDst | Flags::eTransferSrc;
    }
    return common;
}

uint32_t memory_type_of(const DeviceState& state, uint32_t allowed, Buffer::Use use) {
    const vk::MemoryPropertyFlags visible = Memory::eHostVisible | Memory::eHostCoherent;
    if (use == Buffer::Use::download)
        return state.memory_type(allowed, {visible | Memory::eHostCached, visible});
    // On a CPU device all memory is the host's; elsewhere large host-visible heaps need not exist.
    if (state.info.kind == "cpu")
        return state.memory_type(allowed, {Memory::eDeviceLocal | visible, visible});
    return state.memory_type(allowed, {Memory::eDeviceLocal, vk::MemoryPropertyFlags{}});
}

}  // namespace

void full_barrier(const vk::raii::CommandBuffer& commands) {
    const vk::MemoryBarrier barrier(vk::AccessFlagBits::eMemoryWrite,
                                    vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite);
    commands.pipelineBarrier(vk::PipelineStageFlagBits::eAllCommands, vk::PipelineStageFlagBits::eAllCommands,
                             {}, barrier, nullptr, nullptr);
}

Buffer::Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
Buffer::~Buffer() = default;

Buffer::Buffer(const Device& device, size_t bytes, Use use)
    : implementation_(std::make_unique<Implementation>(Implementation{device})) {
    assert(bytes > 0);
    const DeviceState& state = device.state();
    if (state.info.max_allocation != 0 && bytes > state.info.max_allocation)
        throw OutOfMemory(
            ExitCode::device_lost,
            fmt::format("{}: a buffer of {} bytes is more than the device allocates at once ({})",
                        state.info.name, bytes, state.info.max_allocation));
    guarded("allocating a buffer", [&] {
        Implementation& self = *implementation_;
        self.bytes = bytes;
        self.buffer = vk::raii::Buffer(state.device, vk::BufferCreateInfo({}, bytes, usage_of(use)));
        const vk::MemoryRequirements needs = self.buffer.getMemoryRequirements();
        const uint32_t type = memory_type_of(state, needs.memoryTypeBits, use);
        const bool has_address = use != Use::download;
        const vk::MemoryAllocateFlagsInfo flags(has_address ? vk::MemoryAllocateFlagBits::eDeviceAddress
                                                            : vk::MemoryAllocateFlagBits{});
        self.memory = vk::raii::DeviceMemory(
            state.device, vk::MemoryAllocateInfo(needs.size, type, has_address ? &flags : nullptr));
        self.buffer.bindMemory(*self.memory, 0);
        if (has_address) self.address = state.device.getBufferAddress({*self.buffer});
        if (state.memory.memoryTypes[type].propertyFlags & Memory::eHostVisible)
            self.mapped = self.memory.mapMemory(0, VK_WHOLE_SIZE);
    });
}

size_t Buffer::size() const { return implementation_ ? implementation_->bytes : 0; }
uint64_t Buffer::address() const { return implementation_ ? implementation_->address : 0; }

void Buffer::upload(std::span<const std::byte> bytes, size_t offset) {
    assert(offset + bytes.size() <= size());
    if (implementation_->mapped) {
        std::memcpy(static_cast<std::byte*>(implementation_->mapped) + offset, bytes.data(), bytes.size());
        return;
    }
    const Device& device = implementation_->device;
    Buffer staging(device, std::min(bytes.size(), staging_bytes), Use::download);
    for (size_t done = 0; done < bytes.size(); done += staging_bytes) {
        const size_t part = std::min(staging_bytes, bytes.size() - done);
        std::memcpy(staging.implementation_->mapped, bytes.data() + done, part);
        device.state().run("uploading", [&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(handle_of(staging), handle_of(*this), vk::BufferCopy(0, offset + done, part));
            full_barrier(commands);
        });
    }
}

void Buffer::download(std::span<std::byte> bytes) const {
    assert(bytes.size() <= size());
    if (implementation_->mapped) {
        std::memcpy(bytes.data(), implementation_->mapped, bytes.size());
        return;
    }
    const Device& device = implementation_->device;
    const Buffer staging(device, std::min(bytes.size(), staging_bytes), Use::download);
    for (size_t done = 0; done < bytes.size(); done += staging_bytes) {
        const size_t part = std::min(staging_bytes, bytes.size() - done);
        device.state().run("downloading", [&](const vk::raii::CommandBuffer& commands) {
            full_barrier(commands);
            commands.copyBuffer(handle_of(*this), handle_of(staging), vk::BufferCopy(done, 0, part));
            const vk::MemoryBarrier to_host(vk::AccessFlagBits::eTransferWrite,
                                            vk::AccessFlagBits::eHostRead);
            commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost,
                                     {}, to_host, nullptr, nullptr);
        });
        std::memcpy(bytes.data() + done, staging.implementation_->mapped, part);
    }
}

}  // namespace strandlab
