// A Vulkan device: choosing one, what it can do, buffers on it. No Vulkan header beyond this folder.
#pragma once

#include "base/error.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// What a device is and can do, as `info` prints it and results record it.
struct DeviceInfo {
    std::string name;
    std::string driver;       // name and version
    std::string api_version;  // "1.4.305"
    std::string kind;         // cpu, integrated, discrete, virtual, other
    bool is_lavapipe = false;
    /// Hardware traversal. Vulkan does not tell: taken as "not a CPU, and has ray queries", which every
    /// device with ray-tracing units has and the compute cards without them (A100, H100) have not.
    bool has_ray_tracing_hardware = false;
    bool has_ray_query = false;
    bool has_linear_swept_spheres = false;  // VK_NV_ray_tracing_linear_swept_spheres: not used yet
    uint64_t max_leaves = 0;                // of one bottom-level structure (maxPrimitiveCount)
    uint64_t max_allocation = 0;            // bytes of one memory allocation
    uint64_t max_launch = 0;                // ray generation invocations of one launch
    uint64_t memory = 0;                    // bytes of the largest device-local heap
    double timestamp_period = 0;            // nanoseconds per tick; 0: no timestamps
    std::string missing;                    // what ray tracing needs and the device lacks; empty: usable

    bool is_usable() const { return missing.empty(); }
};

/// The device's memory ran out: a smaller scene may fit.
struct OutOfMemory : Error {
    using Error::Error;
};

struct DeviceOptions {
    /// Empty: the best (discrete before integrated before virtual before CPU). Otherwise a part of the
    /// name, a kind, or an index as `info` lists them.
    std::string selector;
    /// Validation layers, with synchronization checks; every message is kept.
    bool validation = false;
    /// Enables ray queries, where the device has them.
    bool ray_query = false;
    /// Enables statistics of compiled shaders, where the driver has them.
    bool pipeline_statistics = false;
};

/// All Vulkan devices of the machine; an Error (no_device) says what to install when there is no loader.
std::vector<DeviceInfo> list_devices();

struct DeviceState;

/// An opened device. Cheap to copy: copies share it.
class Device {
  public:
    /// Opens a device with what ray tracing needs and nothing else; Error (no_device) otherwise.
    explicit Device(const DeviceOptions& options = {});

    const DeviceInfo& info() const;
    /// Messages of the validation layers so far; empty when they are off.
    std::vector<std::string> validation_messages() const;
    bool has_validation() const;
    /// Opened with ray queries, and it has them.
    bool can_query_rays() const;

    DeviceState& state() const { return *state_; }

  private:
    std::shared_ptr<DeviceState> state_;
};

/// A range of device memory that shaders address. Movable.
class Buffer {
  public:
    /// What the buffer is for besides being read and written through its address.
    enum class Use {
        storage,         // shaders, and copies from and to the host
        build_input,     // vertices, indices, boxes, instances of a build
        structure,       // holds an acceleration structure
        scratch,         // of a build
        shader_records,  // a shader binding table
        download,        // host-readable copy target
    };

    Buffer();
    Buffer(const Device& device, size_t bytes, Use use);
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;
    ~Buffer();

    size_t size() const;
    /// Device address; aligned to 256 bytes.
    uint64_t address() const;
    bool is_empty() const { return size() == 0; }

    /// Copies host bytes to the buffer at an offset, through a staging buffer where the memory is not
    /// visible; returns when done.
    void upload(std::span<const std::byte> bytes, size_t offset = 0);
    /// Copies the buffer's first bytes to the host; returns when done.
    void download(std::span<std::byte> bytes) const;

    struct Implementation;
    Implementation& implementation() const { return *implementation_; }

  private:
    std::unique_ptr<Implementation> implementation_;
};

/// A buffer holding a copy of the items (at least 16 bytes, so that its address is valid).
template <class T>
Buffer make_buffer(const Device& device, std::span<const T> items, Buffer::Use use) {
    Buffer buffer(device, items.size_bytes() < 16 ? 16 : items.size_bytes(), use);
    if (!items.empty()) buffer.upload(std::as_bytes(items));
    return buffer;
}

}  // namespace strandlab
