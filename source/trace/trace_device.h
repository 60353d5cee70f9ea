// Where rays are traced: a Vulkan device, or this processor with the C++ version of the shaders' text.
#pragma once

#include "trace/gpu_scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strandlab {

/// Rays where they are traced, with room for their hits: made once, traced through any number of scenes.
class TracedRays {
  public:
    virtual ~TracedRays() = default;
    /// What the last trace wrote; undefined before it.
    virtual Hits hits() const = 0;
};

/// A scene made ready for one primitive.
class TracedScene {
  public:
    virtual ~TracedScene() = default;
    virtual const SceneCost& cost() const = 0;
    virtual TraceResult trace(const Rays& rays, const TraceOptions& options) const = 0;
    /// Traces rays of the same device's upload() once; the device time in milliseconds.
    virtual double run(TracedRays& rays, bool shadow) const = 0;

    /// What each ray of run takes, from an instrumented trace; nothing where a driver's own test tells
    /// nothing (triangles).
    virtual std::optional<std::vector<RayWork>> count_work(TracedRays& rays, bool shadow) const = 0;
    /// run with an intersector that always misses; nothing where the test is a driver's own.
    virtual std::optional<double> run_floor(TracedRays& rays, bool shadow) const = 0;
    /// What the driver tells of the shaders; for that the device is opened with pipeline_statistics.
    virtual std::vector<ShaderStatistic> shader_statistics() const = 0;
};

/// A device by name: "cpu-float" and "cpu-double" are the C++ versions, everything else selects a Vulkan
/// device (see DeviceOptions). Opened once, used for every scene.
class TraceDevice {
  public:
    explicit TraceDevice(const DeviceOptions& options);
    ~TraceDevice();

    const std::string& name() const { return info_.name; }
    /// The Vulkan device; for the C++ versions a name, a driver and the kind "cpu".
    const DeviceInfo& info() const { return info_; }
    /// The Vulkan device; none for the C++ versions.
    const Device* gpu() const { return gpu_.get(); }
    bool has_validation() const;
    /// Throws Error (device_lost) naming the first message when the validation layers said anything.
    void check_validation() const;

    std::unique_ptr<TracedScene> prepare(const Primitive& primitive, std::vector<SceneModel> models,
                                         std::span<const SceneInstance> instances,
                                         const SceneOptions& options) const;
    /// normals: the scenes that they will be traced through were prepared with them.
    std::unique_ptr<TracedRays> upload(const Rays& rays, bool normals) const;

    /// What is known of a Vulkan device's arithmetic; asks it the first time.
    const Arithmetic& arithmetic() const;

  private:
    std::unique_ptr<Device> gpu_;  // none for the C++ versions
    bool is_double_ = false;
    mutable std::optional<Arithmetic> arithmetic_;
    DeviceInfo info_;
};

}  // namespace strandlab
