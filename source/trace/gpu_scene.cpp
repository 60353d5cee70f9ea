#include "trace/gpu_scene.h"

#include "shaders/shared/trace_parameters.h"
#include "base/error.h"
#include "base/parallel.h"
#include "gpu/embedded_shaders.h"
#include "scene/leaf_order.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstring>

namespace strandlab {
namespace {

// Ids of shaders/shared/trace.glsl.
enum ConstantId : uint32_t { has_leaf_table_id = 0, wants_normals_id = 1 };

// gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT
constexpr uint32_t shadow_flags = 0x4u | 0x8u;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// A structure takes up to 128 bytes a leaf on the devices seen, and must fit one allocation.
uint64_t leaves_per_structure(const DeviceInfo& info, uint64_t asked) {
    uint64_t most = info.max_leaves;
    if (info.max_allocation != 0) most = std::min(most, info.max_allocation / 128);
    return std::max<uint64_t>(1, asked != 0 ? std::min(asked, most) : most);
}

BottomLevelInput input_of(const Geometry& geometry, const std::vector<Box>& padded_boxes, size_t first,
                          size_t count) {
    BottomLevelInput input;
    if (geometry.is_triangles()) {
        input.vertices = geometry.vertices;
        input.triangles = std::span(geometry.triangles).subspan(first, count);
    } else {
        input.boxes = {&padded_boxes[first].low.x, 6 * count};
    }
    return input;
}

Buffer upload(const Device& device, const std::vector<std::byte>& bytes, SceneCost& cost) {
    cost.record_bytes += bytes.size();
    return make_buffer(device, std::span<const std::byte>(bytes), Buffer::Use::storage);
}

}  // namespace

GpuScene::GpuScene(const Device& device, const Primitive& primitive, std::vector<SceneModel> models,
                   std::span<const SceneInstance> instances, const SceneOptions& options)
    : device_(device), normals_(options.normals) {
    const bool keeps_order = device.info().is_lavapipe;
    const bool reorders = options.order == SceneOptions::Order::median ||
                          (options.order == SceneOptions::Order::automatic && keeps_order);
    for (SceneModel& model : models) {
        assert(model.geometry.constants == models.front().geometry.constants);
        if (!reorders || model.geometry.leaf_count() < 3) continue;
        const auto start = std::chrono::steady_clock::now();
        reorder_leaves(model.geometry, median_order(leaf_boxes(model.geometry)));
        cost_.order_ms += milliseconds_since(start);
    }
    has_leaf_table_ = std::any_of(models.begin(), models.end(),
                                  [](const SceneModel& m) { return m.geometry.uniform_pieces == 0; });
    for (uint32_t i = 0; i < models.size(); ++i) add_model(models[i], i, options);
    add_instances(instances, models);
    if (!parts_.empty()) make_pipeline(primitive, models.front().geometry.constants);
}

void GpuScene::add_model(const SceneModel& model, uint32_t index, const SceneOptions& options) {
    const Geometry& geometry = model.geometry;
    const auto start = std::chrono::steady_clock::now();
    ModelBuffers& buffers = model_buffers_.emplace_back();
    if (has_leaf_table_) {
        buffers.leaves = make_buffer(device_, std::span<const Leaf>(geometry.leaves), Buffer::Use::storage);
        cost_.record_bytes += geometry.leaves.size() * sizeof(Leaf);
    }
    if (geometry.leaf_records.stride != 0)
        buffers.leaf_records = upload(device_, geometry.leaf_records.bytes, cost_);
    if (geometry.curve_records.stride != 0)
        buffers.curve_records = upload(device_, geometry.curve_records.bytes, cost_);
    if (geometry.shading_records.stride != 0 && (options.normals || geometry.always_shades))
        buffers.shading_records = upload(device_, geometry.shading_records.bytes, cost_);
    cost_.builds.upload_ms += milliseconds_since(start);
    cost_.leaf_count += geometry.leaf_count();

    std::vector<Box> boxes(geometry.boxes.size());
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(geometry.boxes[i], options.ray_extent); });
    const size_t most = leaves_per_structure(device_.info(), options.max_leaves);
    for (size_t first = 0; first < geometry.leaf_count(); first += most) {
        const size_t count = std::min(most, geometry.leaf_count() - first);
        BottomLevelInput input = input_of(geometry, boxes, first, count);
        input.compact = options.compact;
        parts_.push_back(
            {build_bottom_level(device_, input, cost_.builds), index, static_cast<uint32_t>(first)});
        ++cost_.structure_count;
    }
}

void GpuScene::add_instances(std::span<const SceneInstance> instances,
                             const std::vector<SceneModel>& models) {
    if (parts_.empty()) return;
    std::vector<layout::GeometryRow> rows;
    std::vector<InstanceInput> inputs;
    for (uint32_t i = 0; i < instances.size(); ++i) {
        for (const Part& part : parts_) {
            if (part.model != instances[i].model) continue;
            const ModelBuffers& buffers = model_buffers_[part.model];
            inputs.push_back({instances[i].world_from_object, part.structure.address(),
                              static_cast<uint32_t>(rows.size())});
            rows.push_back({buffers.leaves.address(), buffers.leaf_records.address(),
                            buffers.curve_records.address(), buffers.shading_records.address(),
                            part.first_leaf, models[part.model].first_curve,
                            models[part.model].geometry.uniform_pieces, i});
        }
    }
    if (rows.size() >= (size_t(1) << 24))
        fail(ExitCode::device_lost, "{} instances of structures are more than Vulkan's 24-bit index takes",
             rows.size());
    rows_ = make_buffer(device_, std::span<const layout::GeometryRow>(rows), Buffer::Use::storage);
    cost_.record_bytes += rows.size() * sizeof(rows[0]);
    top_ = build_top_level(device_, inputs, cost_.builds);
}

void GpuScene::make_pipeline(const Primitive& primitive, const std::vector<Constant>& constants) {
    const auto start = std::chrono::steady_clock::now();
    const PrimitiveShaders& shaders = primitive.shaders;
    const PipelineStages stages{embedded_shader("trace.rgen"), embedded_shader("trace.rmiss"),
                                embedded_shader(shaders.closest_hit), embedded_shader(shaders.intersection),
                                embedded_shader(shaders.any_hit)};
    assert(!stages.closest_hit.empty() && (shaders.intersection.empty() || !stages.intersection.empty()));
    PipelineConstants all = constants;
    all.emplace_back(has_leaf_table_id, has_leaf_table_ ? 1u : 0u);
    all.emplace_back(wants_normals_id, normals_ ? 1u : 0u);
    pipeline_.emplace(device_, stages, all, static_cast<uint32_t>(sizeof(layout::TraceParameters)));
    cost_.pipeline_ms = milliseconds_since(start);
}

std::vector<RayTracingPipeline::Launch> GpuScene::launches(const Rays& rays,
                                                           layout::TraceParameters parameters) const {
    const auto count = static_cast<uint32_t>(rays.rays.size());
    // Pictures are launched in their own shape, which keeps neighbouring rays together on GPUs. Other sets
    // have neighbours only along the list: in a launch of another shape, tiles of it would mix far rays.
    constexpr uint32_t longest_row = 1u << 16;
    const bool shaped = rays.width != 0 && uint64_t(rays.width) * rays.height >= count;
    const uint32_t width = shaped ? rays.width : std::min(count, longest_row);
    const uint32_t height = (count + width - 1) / width;
    const auto rows = static_cast<uint32_t>(
        std::clamp<uint64_t>(device_.info().max_launch / width, 1, height));  // of one launch
    std::vector<RayTracingPipeline::Launch> all;
    for (uint32_t row = 0; row < height; row += rows) {
        parameters.first_ray = row * width;
        RayTracingPipeline::Launch& launch = all.emplace_back();
        launch.push_constants.resize(sizeof parameters);
        std::memcpy(launch.push_constants.data(), &parameters, sizeof parameters);
        launch.width = width;
        launch.height = std::min(rows, height - row);
    }
    return all;
}

TraceResult GpuScene::trace(const Rays& rays, const TraceOptions& options) const {
    TraceResult result;
    result.hits.hits.resize(rays.rays.size());
    if (normals_) result.hits.normals.resize(rays.rays.size());
    if (rays.rays.empty() || !pipeline_) {
        result.milliseconds.assign(options.samples, 0.0);
        return result;
    }
    std::vector<Ray> valid = rays.rays;
    disable_invalid(valid);
    const Buffer ray_buffer = make_buffer(device_, std::span<const Ray>(valid), Buffer::Use::storage);
    const Buffer hit_buffer(device_, std::max<size_t>(16, valid.size() * sizeof(Hit)), Buffer::Use::storage);
    Buffer normal_buffer;
    if (normals_)
        normal_buffer =
            Buffer(device_, std::max<size_t>(16, valid.size() * sizeof(glm::vec3)), Buffer::Use::storage);
    layout::TraceParameters parameters{top_.address(), ray_buffer.address(), hit_buffer.address(),
                                       normal_buffer.address(), rows_.address()};
    parameters.ray_count = static_cast<uint32_t>(valid.size());
    parameters.ray_flags = options.shadow ? shadow_flags : 0;
    parameters.is_shadow = options.shadow ? 1 : 0;
    const auto all = launches(rays, parameters);
    for (double spent = 0; spent < options.warm_up_ms;) spent += std::max(1e-3, pipeline_->run(all));
    for (uint32_t i = 0; i < options.samples; ++i) result.milliseconds.push_back(pipeline_->run(all));
    hit_buffer.download(std::as_writable_bytes(std::span(result.hits.hits)));
    if (normals_) normal_buffer.download(std::as_writable_bytes(std::span(result.hits.normals)));
    return result;
}

}  // namespace strandlab
