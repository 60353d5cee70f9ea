#include "trace/gpu_scene.h"

#include "shaders/shared/trace_parameters.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "scene/leaf_order.h"
#include "scene/shared_records.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

namespace strandlab {
namespace {

// Ids of shaders/shared/trace.glsl.
enum ConstantId : uint32_t {
    has_leaf_table_id = 0,
    wants_normals_id = 1,
    curves_of_a_ray_id = 2,
    uniform_pieces_id = 3,
    has_one_row_id = 4,
    is_in_place_id = 5,
    early_out_id = 6,
    gentle_first_id = 7,
    blocks_of_lanes_id = 9,
    strand_curves_id = 10,
    hardware_fma_id = 15  // shaders/shared/portable.h
};

// gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT
constexpr uint32_t shadow_flags = 0x4u | 0x8u;

/// What a number is in every model that has leaves; 0 where they differ or there are none.
template <class NumberOf>
uint32_t common_value(std::span<const SceneModel> models, NumberOf&& number_of) {
    std::optional<uint32_t> common;
    for (const SceneModel& model : models) {
        if (model.leaf_count() == 0) continue;
        const uint32_t number = number_of(model.geometry);
        if (common && number != *common) return 0;
        common = number;
    }
    return common.value_or(0);
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

BottomLevelInput device_input(const DeviceLeaves& leaves, size_t first, size_t count) {
    BottomLevelInput input;
    input.device_boxes = leaves.boxes.address() + first * sizeof(Box);
    input.device_box_count = count;
    return input;
}

/// Puts the leaves in the order of the rays that they belong to.
void order_by_ray(Geometry& geometry, uint32_t curves) {
    std::vector<uint32_t> order(geometry.leaf_count());
    std::iota(order.begin(), order.end(), 0u);
    const auto ray = [&](uint32_t leaf) { return geometry.leaves[leaf].curve / curves; };
    const auto before = [&](uint32_t a, uint32_t b) { return ray(a) < ray(b); };
    if (std::is_sorted(order.begin(), order.end(), before)) return;
    std::stable_sort(order.begin(), order.end(), before);
    reorder_leaves(geometry, order);
}

/// About `count` leaves from `first` on, as many more as leave no ray's leaves cut in two.
size_t whole_rays(std::span<const Leaf> leaves, size_t first, size_t count, uint32_t curves) {
    size_t end = first + count;
    const auto cuts = [&](size_t i) { return leaves[i].curve / curves == leaves[i - 1].curve / curves; };
    while (end < leaves.size() && cuts(end)) ++end;
    return end - first;
}

Buffer upload(const Device& device, const std::vector<std::byte>& bytes, SceneCost& cost) {
    cost.record_bytes += bytes.size();
    return make_buffer(device, std::span<const std::byte>(bytes), Buffer::Use::storage);
}

}  // namespace

GpuScene::GpuScene(const Device& device, const Primitive& primitive, std::vector<SceneModel> models,
                   std::span<const SceneInstance> instances, const SceneOptions& options)
    : device_(device),
      normals_(options.normals),
      curves_of_a_ray_(options.curves_of_a_ray),
      arithmetic_(options.arithmetic),
      no_skips_(options.no_skips),
      curve_numbers_(options.curve_numbers) {
    for (SceneModel& model : models) {
        if (curves_of_a_ray_ != 0) order_by_ray(model.geometry, curves_of_a_ray_);
        assert(model.geometry.constants == models.front().geometry.constants);
        if (reorders(device.info(), options) && model.geometry.leaf_count() >= 3)
            order_leaves(model.geometry);
    }
    choose_skips(models, instances);
    for (uint32_t i = 0; i < models.size(); ++i) add_model(models[i], i, options);
    add_instances(instances, models);
    if (!parts_.empty()) make_pipeline(primitive, models.front().geometry.constants, options);
}

bool GpuScene::reorders(const DeviceInfo& device, const SceneOptions& options) {
    const bool keeps_order = device.is_lavapipe;
    return options.curves_of_a_ray == 0 && (options.order == SceneOptions::Order::median ||
                                            (options.order == SceneOptions::Order::automatic && keeps_order));
}

void GpuScene::order_leaves(Geometry& geometry) {
    const Stopwatch stopwatch;
    const KnownOrder known = known_median_order(leaf_boxes(geometry));
    reorder_leaves(geometry, known.order);
    cost_.order_ms += stopwatch.milliseconds();
    cost_.order_cached |= known.was_cached;
}

void GpuScene::choose_skips(std::span<const SceneModel> models, std::span<const SceneInstance> instances) {
    const auto is_uniform = [](const SceneModel& model) { return model.geometry.uniform_pieces != 0; };
    const auto is_in_place = [](const SceneInstance& i) { return i.world_from_object == glm::mat4x3(1.0f); };
    const uint32_t pieces =
        common_value(models, [](const Geometry& geometry) { return geometry.uniform_pieces; });
    const uint32_t strand_curves = common_value(
        models, [](const Geometry& geometry) { return overlapping_in_a_row(geometry.curve_records); });
    has_leaf_table_ = !skips("leaf-table", std::all_of(models.begin(), models.end(), is_uniform));
    const auto is_on_device = [](const SceneModel& model) { return model.on_device != nullptr; };
    if ((has_leaf_table_ || curves_of_a_ray_ != 0) && std::any_of(models.begin(), models.end(), is_on_device))
        fail(ExitCode::usage,
             "models that grow on the device have no table of leaves: leave out --no-skip leaf-table");
    if (!has_leaf_table_ && skips("pieces", pieces != 0)) uniform_pieces_ = pieces;
    if (skips("points", strand_curves != 0)) strand_curves_ = strand_curves;
    is_in_place_ = skips("transform", std::all_of(instances.begin(), instances.end(), is_in_place));
}

void GpuScene::add_model(const SceneModel& model, uint32_t index, const SceneOptions& options) {
    const Geometry& geometry = model.geometry;
    const Stopwatch stopwatch;
    ModelBuffers& buffers = model_buffers_.emplace_back();
    if (model.on_device) {
        buffers.curve_records = std::move(model.on_device->curve_records);
        cost_.record_bytes += buffers.curve_records.size();
    } else if (has_leaf_table_) {
        buffers.leaves = make_buffer(device_, std::span<const Leaf>(geometry.leaves), Buffer::Use::storage);
        cost_.record_bytes += geometry.leaves.size() * sizeof(Leaf);
    }
    if (geometry.leaf_records.stride != 0)
        buffers.leaf_records = upload(device_, geometry.leaf_records.bytes, cost_);
    if (geometry.curve_records.stride != 0)
        buffers.curve_records =
            strand_curves_ == 0
                ? upload(device_, geometry.curve_records.bytes, cost_)
                : upload(device_, without_overlaps(geometry.curve_records, strand_curves_), cost_);
    if (geometry.shading_records.stride != 0 && (options.normals || geometry.always_shades))
        buffers.shading_records = upload(device_, geometry.shading_records.bytes, cost_);
    cost_.builds.upload_ms += stopwatch.milliseconds();
    cost_.leaf_count += model.leaf_count();

    std::vector<Box> boxes(geometry.boxes.size());
    parallel_for(boxes.size(), [&](size_t i) { boxes[i] = padded(geometry.boxes[i], options.ray_extent); });
    const size_t most = leaves_per_structure(device_.info(), options.max_leaves);
    const size_t first_part = parts_.size();
    std::vector<BottomLevelInput> inputs;
    for (size_t first = 0, count = 0; first < model.leaf_count(); first += count) {
        count = std::min(most, model.leaf_count() - first);
        if (curves_of_a_ray_ != 0) count = whole_rays(geometry.leaves, first, count, curves_of_a_ray_);
        BottomLevelInput& input =
            inputs.emplace_back(model.on_device ? device_input(*model.on_device, first, count)
                                                : input_of(geometry, boxes, first, count));
        input.compact = options.compact;
        input.low_memory = options.low_memory;
        if (first_part == 0 && first == 0) input.warm_up_ms = options.build_warm_up_ms;
        input.opaque = curves_of_a_ray_ == 0;
        parts_.push_back({{}, index, static_cast<uint32_t>(first)});
        ++cost_.structure_count;
    }
    build_parts(inputs, first_part);
    if (model.on_device) model.on_device->boxes = {};
}

void GpuScene::build_parts(std::span<const BottomLevelInput> inputs, size_t first_part) {
    if (curves_of_a_ray_ == 0) {
        for (size_t i = 0; i < inputs.size(); ++i)
            parts_[first_part + i].structure = build_bottom_level(device_, inputs[i], cost_.builds);
        return;
    }
    // Many small ones: on a GPU an allocation costs more than a build.
    std::vector<AccelerationStructure> built = build_bottom_levels(device_, inputs, cost_.builds);
    for (size_t i = 0; i < built.size(); ++i) parts_[first_part + i].structure = std::move(built[i]);
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
    if (skips("rows", rows.size() == 1)) row_ = rows;
    rows_ = make_buffer(device_, std::span<const layout::GeometryRow>(rows), Buffer::Use::storage);
    cost_.record_bytes += rows.size() * sizeof(rows[0]);
    add_tops(inputs, models);
}

void GpuScene::add_tops(std::span<const InstanceInput> inputs, const std::vector<SceneModel>& models) {
    if (curves_of_a_ray_ == 0) {
        tops_.push_back({build_top_level(device_, inputs, cost_.builds)});
        return;
    }
    assert(models.size() == 1 && inputs.size() == parts_.size());
    std::vector<AccelerationStructure> built = build_top_levels(device_, inputs, cost_.builds);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const Leaf& leaf = models[0].geometry.leaves[parts_[i].first_leaf];
        // Rays without leaves are traced with the structure before theirs, or the first, and miss.
        const uint32_t first = i == 0 ? 0 : leaf.curve / curves_of_a_ray_;
        if (i > 0) tops_.back().end_ray = first;
        tops_.push_back({std::move(built[i]), first});
    }
}

void GpuScene::make_pipeline(const Primitive& primitive, const std::vector<Constant>& constants,
                             const SceneOptions& options) {
    const Stopwatch stopwatch;
    has_intersector_ = !primitive.shaders.intersection.empty();
    PipelineConstants all = constants;
    all.emplace_back(has_leaf_table_id, has_leaf_table_ ? 1u : 0u);
    all.emplace_back(wants_normals_id, normals_ ? 1u : 0u);
    all.emplace_back(curves_of_a_ray_id, curves_of_a_ray_);
    all.emplace_back(uniform_pieces_id, uniform_pieces_);
    all.emplace_back(strand_curves_id, strand_curves_);
    all.emplace_back(has_one_row_id, row_.empty() ? 0u : 1u);
    all.emplace_back(is_in_place_id, is_in_place_ ? 1u : 0u);
    all.emplace_back(early_out_id, skips("early-out", has_intersector_) ? 1u : 0u);
    all.emplace_back(gentle_first_id, skips("gentle", has_intersector_) ? 1u : 0u);
    all.emplace_back(hardware_fma_id, skips("splitting", arithmetic_.fuses_fma) ? 1u : 0u);
    // On processors eight rays in a row of a picture share a vector: four by two meet more of the same boxes.
    all.emplace_back(blocks_of_lanes_id, device_.info().kind == "cpu" ? 1u : 0u);
    const bool is_loose = has_intersector_ && arithmetic_.rounds_loosely();
    const bool alike = !skips("rounding", is_loose) && is_loose;
    pipelines_ =
        ScenePipelines(device_, primitive, std::move(all), alike ? arithmetic_.alike() : ShaderRounding{},
                       curves_of_a_ray_ != 0, options.pipelines);
    cost_.traversal = options.traversal;
    if (options.traversal != Traversal::pipeline && !device_.can_query_rays()) {
        if (options.traversal == Traversal::query)
            fail(ExitCode::no_device, "--traversal query: {} has no ray queries; choose pipeline or auto",
                 device_.info().name);
        cost_.traversal = Traversal::pipeline;
    }
    if (cost_.traversal != Traversal::automatic)
        pipeline_ = pipelines_.make({.by_query = cost_.traversal == Traversal::query});
    cost_.pipeline_ms = stopwatch.milliseconds();
}

bool GpuScene::skips(const char* name, bool is_possible) {
    const bool skipped =
        is_possible && std::find(no_skips_.begin(), no_skips_.end(), name) == no_skips_.end();
    if (skipped) cost_.skipped.emplace_back(name);
    return skipped;
}

std::vector<TracePipeline::Launch> GpuScene::launches(const GpuRays& rays, bool shadow) const {
    layout::TraceParameters parameters{0,
                                       rays.rays_.address(),
                                       rays.hits_.address(),
                                       normals_ ? rays.normals_.address() : 0,
                                       rows_.address(),
                                       0,
                                       0,
                                       0,
                                       0,
                                       {},
                                       rays.counters_.is_empty() ? 0 : rays.counters_.address(),
                                       0,
                                       0};
    parameters.ray_flags = shadow ? shadow_flags : 0;
    parameters.is_shadow = shadow ? 1 : 0;
    if (!row_.empty()) parameters.row = row_.front();
    std::vector<TracePipeline::Launch> all;
    for (const Top& top : tops_) add_launches(rays, parameters, top, all);
    return all;
}

void GpuScene::add_launches(const GpuRays& rays, layout::TraceParameters parameters, const Top& top,
                            std::vector<TracePipeline::Launch>& all) const {
    const auto end = static_cast<uint32_t>(std::min<size_t>(rays.count_, top.end_ray));
    if (top.first_ray >= end) return;
    const uint32_t count = end - top.first_ray;
    // Pictures are launched in their own shape, which keeps neighbouring rays together on GPUs. Other sets
    // have neighbours only along the list: in a launch of another shape, tiles of it would mix far rays.
    constexpr uint32_t longest_row = 1u << 16;
    const bool shaped =
        rays.width_ != 0 && uint64_t(rays.width_) * rays.height_ >= count && tops_.size() == 1;
    const uint32_t width = shaped ? rays.width_ : std::min(count, longest_row);
    const uint32_t height = (count + width - 1) / width;
    const auto rows = static_cast<uint32_t>(
        std::clamp<uint64_t>(device_.info().max_launch / width, 1, height));  // of one launch
    parameters.scene = top.structure.address();
    parameters.ray_count = end;
    parameters.width = width;
    parameters.is_tiled = shaped ? 1 : 0;
    for (uint32_t row = 0; row < height; row += rows) {
        parameters.first_ray = top.first_ray + row * width;
        TracePipeline::Launch& launch = all.emplace_back();
        launch.push_constants.resize(sizeof parameters);
        std::memcpy(launch.push_constants.data(), &parameters, sizeof parameters);
        launch.width = width;
        launch.height = std::min(rows, height - row);
        launch.is_tiled = shaped;
    }
}

double GpuScene::run(GpuRays& rays, bool shadow) const {
    assert(!normals_ || !rays.normals_.is_empty() || rays.count_ == 0);
    rays.curve_numbers_ = shadow ? nullptr : curve_numbers_;
    if (rays.count_ == 0) return 0;
    if (!parts_.empty()) return pipeline_for(rays, shadow).run(launches(rays, shadow));
    // Without leaves there is nothing to trace: every ray misses.
    const std::vector<Hit> misses(rays.count_);
    rays.hits_.upload(std::as_bytes(std::span(misses)));
    return 0;
}

TraceResult GpuScene::trace(const Rays& rays, const TraceOptions& options) const {
    GpuRays buffers(device_, rays, normals_);
    TraceResult result;
    for (double spent = 0; !parts_.empty() && !rays.rays.empty() && spent < options.warm_up_ms;)
        spent += std::max(1e-3, run(buffers, options.shadow));
    for (uint32_t i = 0; i < options.samples; ++i)
        result.milliseconds.push_back(run(buffers, options.shadow));
    result.hits = buffers.hits();
    return result;
}

GpuRays::GpuRays(const Device& device, const Rays& rays, bool normals)
    : count_(rays.rays.size()), width_(rays.width), height_(rays.height) {
    if (count_ == 0) return;
    std::vector<Ray> valid = rays.rays;
    disable_invalid(valid);
    rays_ = make_buffer(device, std::span<const Ray>(valid), Buffer::Use::storage);
    hits_ = Buffer(device, std::max<size_t>(16, count_ * sizeof(Hit)), Buffer::Use::storage);
    if (normals)
        normals_ = Buffer(device, std::max<size_t>(16, count_ * sizeof(glm::vec3)), Buffer::Use::storage);
}

Hits GpuRays::hits() const {
    Hits result;
    result.hits.resize(count_);
    if (count_ != 0) hits_.download(std::as_writable_bytes(std::span(result.hits)));
    if (curve_numbers_)
        parallel_for(count_, [&](size_t i) {
            uint32_t& curve = result.hits[i].curve;
            if (curve < curve_numbers_->size()) curve = (*curve_numbers_)[curve];
        });
    if (normals_.is_empty()) return result;
    result.normals.resize(count_);
    normals_.download(std::as_writable_bytes(std::span(result.normals)));
    return result;
}

}  // namespace strandlab
