#include "trace/trace_device.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "trace/cpu_trace.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strandlab {
namespace {

class GpuTracedRays : public TracedRays {
  public:
    GpuTracedRays(const Device& device, const Rays& all, bool normals) : rays(device, all, normals) {}
    Hits hits() const override { return rays.hits(); }

    GpuRays rays;
};

class GpuTraced : public TracedScene {
  public:
    GpuTraced(const Device& device, const Primitive& primitive, std::vector<SceneModel> models,
              std::span<const SceneInstance> instances, const SceneOptions& options)
        : scene_(device, primitive, std::move(models), instances, options) {}
    const SceneCost& cost() const override { return scene_.cost(); }
    TraceResult trace(const Rays& rays, const TraceOptions& options) const override {
        return scene_.trace(rays, options);
    }
    double run(TracedRays& rays, bool shadow) const override {
        return scene_.run(static_cast<GpuTracedRays&>(rays).rays, shadow);
    }
    std::optional<std::vector<RayWork>> count_work(TracedRays& rays, bool shadow) const override {
        return scene_.count_work(static_cast<GpuTracedRays&>(rays).rays, shadow);
    }
    std::optional<double> run_floor(TracedRays& rays, bool shadow) const override {
        return scene_.run_floor(static_cast<GpuTracedRays&>(rays).rays, shadow);
    }
    std::vector<ShaderStatistic> shader_statistics() const override { return scene_.shader_statistics(); }

  private:
    GpuScene scene_;
};

class CpuTracedRays : public TracedRays {
  public:
    CpuTracedRays(const Rays& all, bool normals) : rays(all.rays) {
        found.hits.resize(rays.size());
        if (normals) found.normals.resize(rays.size());
    }
    Hits hits() const override { return found; }

    std::vector<Ray> rays;
    Hits found;
};

/// The kernels through our own hierarchy; instances one after the other (there is no hierarchy over them).
class CpuTraced : public TracedScene {
  public:
    CpuTraced(const Primitive& primitive, Precision precision, std::vector<SceneModel> models,
              std::span<const SceneInstance> instances, const SceneOptions& options)
        : models_(std::move(models)),
          instances_(instances.begin(), instances.end()),
          normals_(options.normals),
          curve_numbers_(options.curve_numbers) {
        const Stopwatch stopwatch;
        tracers_.reserve(models_.size());
        for (const SceneModel& model : models_) {
            tracers_.emplace_back(model.geometry, primitive, precision, options.ray_extent);
            const Geometry& g = model.geometry;
            cost_.record_bytes +=
                g.leaves.size() * sizeof(Leaf) + g.leaf_records.bytes.size() + g.curve_records.bytes.size();
            cost_.leaf_count += g.leaf_count();
            cost_.structure_count += 1;
        }
        cost_.builds.build_ms = stopwatch.milliseconds();
    }

    const SceneCost& cost() const override { return cost_; }

    TraceResult trace(const Rays& rays, const TraceOptions& options) const override {
        CpuTracedRays buffers(rays, normals_);
        TraceResult result;
        for (uint32_t sample = 0; sample < options.samples; ++sample)
            result.milliseconds.push_back(run(buffers, options.shadow));
        result.hits = std::move(buffers.found);
        return result;
    }

    double run(TracedRays& traced, bool shadow) const override {
        const std::vector<Ray>& rays = static_cast<CpuTracedRays&>(traced).rays;
        Hits& found = static_cast<CpuTracedRays&>(traced).found;
        assert(!normals_ || found.normals.size() == rays.size());
        const Stopwatch stopwatch;
        parallel_for(rays.size(), [&](size_t i) {
            glm::vec3 normal(0);
            found.hits[i] = trace_one(rays[i], shadow, normal);
            if (normals_) found.normals[i] = normal;
        });
        return stopwatch.milliseconds();
    }

    std::optional<std::vector<RayWork>> count_work(TracedRays& traced, bool shadow) const override {
        const std::vector<Ray>& rays = static_cast<CpuTracedRays&>(traced).rays;
        std::vector<RayWork> work(rays.size());
        parallel_for(rays.size(), [&](size_t i) { work[i] = work_of(rays[i], shadow); });
        return work;
    }

    std::optional<double> run_floor(TracedRays& traced, bool) const override {
        const std::vector<Ray>& rays = static_cast<CpuTracedRays&>(traced).rays;
        std::vector<uint32_t> leaves(rays.size());  // kept, so that the walk is not optimised away
        const Stopwatch stopwatch;
        parallel_for(rays.size(), [&](size_t i) {
            if (!is_valid(rays[i])) return;
            for (const SceneInstance& instance : instances_)
                leaves[i] += tracers_[instance.model].walk(in_object_space(rays[i], instance));
        });
        return stopwatch.milliseconds();
    }

    std::vector<ShaderStatistic> shader_statistics() const override { return {}; }

  private:
    static Ray in_object_space(const Ray& ray, const SceneInstance& instance) {
        if (instance.world_from_object == glm::mat4x3(1.0f)) return ray;
        const glm::mat3 inverse = glm::inverse(glm::mat3(instance.world_from_object));
        return {inverse * (ray.origin - instance.world_from_object[3]), ray.tmin, inverse * ray.direction,
                ray.tmax};
    }

    RayWork work_of(Ray ray, bool shadow) const {
        RayWork all;
        if (!is_valid(ray)) return all;
        const auto mode = shadow ? TraceMode::any : TraceMode::closest;
        for (const SceneInstance& instance : instances_) {
            const CpuTracer& tracer = tracers_[instance.model];
            const Ray object = in_object_space(ray, instance);
            const RayWork one = tracer.work(object, mode);
            all.leaves += one.leaves;
            all.searched += one.searched;
            all.iterations += one.iterations;
            all.reports += one.reports;
            if (one.reports == 0) continue;
            if (shadow) break;
            ray.tmax = std::min(ray.tmax, tracer.trace(object, mode).t);
        }
        return all;
    }

    Hit trace_one(Ray ray, bool shadow, glm::vec3& normal) const {
        Hit best;
        if (!is_valid(ray)) return best;
        for (uint32_t i = 0; i < instances_.size(); ++i) {
            const SceneInstance& instance = instances_[i];
            Hit hit;
            glm::vec3 object_normal(0);
            const auto mode = shadow ? TraceMode::any : TraceMode::closest;
            hit = tracers_[instance.model].trace(in_object_space(ray, instance), mode, &object_normal);
            if (hit.is_hit() && instance.world_from_object != glm::mat4x3(1.0f))
                object_normal =
                    glm::normalize(object_normal * glm::inverse(glm::mat3(instance.world_from_object)));
            if (!hit.is_hit()) continue;
            if (shadow) return {ray.tmin, 0, 0, 0};
            hit.curve += models_[instance.model].first_curve;
            if (curve_numbers_) hit.curve = (*curve_numbers_)[hit.curve];
            hit.instance = i;
            best = hit;
            normal = object_normal;
            ray.tmax = hit.t;
        }
        return best;
    }

    std::vector<SceneModel> models_;
    std::vector<SceneInstance> instances_;
    std::vector<CpuTracer> tracers_;
    bool normals_;
    CurveNumbers curve_numbers_;
    SceneCost cost_;
};

}  // namespace

TraceDevice::TraceDevice(const DeviceOptions& options) {
    if (options.selector == "cpu-float" || options.selector == "cpu-double") {
        if (options.validation)
            fail(ExitCode::usage, "--validation: {} does not use Vulkan; leave one of the two out",
                 options.selector);
        is_double_ = options.selector == "cpu-double";
        info_.name = options.selector;
        info_.driver = is_double_ ? "C++ double" : "C++ float";
        info_.api_version = "none";
        info_.kind = "cpu";
        return;
    }
    gpu_ = std::make_unique<Device>(options);
    info_ = gpu_->info();
}

TraceDevice::~TraceDevice() = default;

bool TraceDevice::has_validation() const { return gpu_ && gpu_->has_validation(); }

void TraceDevice::check_validation() const {
    if (!has_validation()) return;
    const std::vector<std::string> messages = gpu_->validation_messages();
    if (messages.empty()) return;
    fail(ExitCode::device_lost, "--validation: {} messages, the first: {}", messages.size(),
         messages.front());
}

const Arithmetic& TraceDevice::arithmetic() const {
    // Processors' drivers are known to neither fuse nor approximate (see `strandlab info`); asking them costs
    // the compilation of a shader.
    if (!arithmetic_) arithmetic_ = info_.kind == "cpu" ? Arithmetic{} : arithmetic_of(*gpu_);
    return *arithmetic_;
}

std::unique_ptr<TracedScene> TraceDevice::prepare(const Primitive& primitive, std::vector<SceneModel> models,
                                                  std::span<const SceneInstance> instances,
                                                  const SceneOptions& options) const {
    if (gpu_) {
        SceneOptions known = options;
        known.arithmetic = arithmetic();
        return std::make_unique<GpuTraced>(*gpu_, primitive, std::move(models), instances, known);
    }
    return std::make_unique<CpuTraced>(primitive, is_double_ ? Precision::precise : Precision::single,
                                       std::move(models), instances, options);
}

std::unique_ptr<TracedRays> TraceDevice::upload(const Rays& rays, bool normals) const {
    if (gpu_) return std::make_unique<GpuTracedRays>(*gpu_, rays, normals);
    return std::make_unique<CpuTracedRays>(rays, normals);
}

}  // namespace strandlab
