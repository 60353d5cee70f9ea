// What a scene's traces are made of: instrumented and empty intersectors, and the choice of the traversal.
#include "base/cache.h"
#include "gpu/embedded_shaders.h"
#include "trace/gpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace strandlab {
namespace {

/// Traces of each kind that the choice rests on, after one that compiles and warms up.
constexpr int calibration_rounds = 3;

std::optional<TraversalTimes> read_times(const std::string& key) {
    const auto bytes = cache_read(key);
    if (!bytes || bytes->size() != sizeof(TraversalTimes)) return std::nullopt;
    TraversalTimes times;
    std::memcpy(&times, bytes->data(), sizeof times);
    return times;
}

}  // namespace

const TracePipeline& GpuScene::pipeline_for(GpuRays& rays, bool shadow) const {
    if (pipeline_) return *pipeline_;
    const std::string key =
        fmt::format("traversal/1 device={} driver={} shaders={:016x} pipeline={}", device_.info().name,
                    device_.info().driver, embedded_shader_hash(), pipelines_.name_of({}));
    std::optional<TraversalTimes> times = read_times(key);
    if (!times) {
        times = measure_traversal(rays, shadow);
        cache_write(key, std::as_bytes(std::span(&*times, 1)));
    }
    cost_.traversal_times = times;
    cost_.traversal = times->faster();
    pipeline_ = pipelines_.make({.by_query = cost_.traversal == Traversal::query});
    return *pipeline_;
}

TraversalTimes GpuScene::measure_traversal(GpuRays& rays, bool shadow) const {
    const std::vector<TracePipeline::Launch> all = launches(rays, shadow);
    const PipelineStore::Pipeline pipeline = pipelines_.make({}), query = pipelines_.make({.by_query = true});
    pipeline->run(all);
    query->run(all);
    TraversalTimes best{pipeline->run(all), query->run(all)};
    for (int i = 1; i < calibration_rounds; ++i) {
        best.query_ms = std::min(best.query_ms, query->run(all));
        best.pipeline_ms = std::min(best.pipeline_ms, pipeline->run(all));
    }
    return best;
}

std::optional<std::vector<RayWork>> GpuScene::count_work(GpuRays& rays, bool shadow) const {
    if (parts_.empty() || rays.count_ == 0) return std::vector<RayWork>(rays.count_);
    if (!has_intersector_) return std::nullopt;
    pipeline_for(rays, shadow);
    rays.clear_counters(device_);
    rays.curve_numbers_ = shadow ? nullptr : curve_numbers_;
    const bool by_query = cost_.traversal == Traversal::query;
    pipelines_.make({.by_query = by_query, .counts_work = true})->run(launches(rays, shadow));
    std::vector<RayWork> work(rays.count_);
    rays.counters_.download(std::as_writable_bytes(std::span(work)));
    return work;
}

std::optional<double> GpuScene::run_floor(GpuRays& rays, bool shadow) const {
    if (parts_.empty() || rays.count_ == 0) return 0.0;
    if (!has_intersector_) return std::nullopt;
    pipeline_for(rays, shadow);
    const bool by_query = cost_.traversal == Traversal::query;
    return pipelines_.make({.by_query = by_query, .never_hits = true})->run(launches(rays, shadow));
}

std::vector<ShaderStatistic> GpuScene::shader_statistics() const {
    return pipeline_ ? pipeline_->statistics() : std::vector<ShaderStatistic>();
}

void GpuRays::clear_counters(const Device& device) {
    const std::vector<RayWork> zero(count_);
    counters_ = make_buffer(device, std::span<const RayWork>(zero), Buffer::Use::storage);
}

}  // namespace strandlab
