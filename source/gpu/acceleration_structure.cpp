#include "gpu/acceleration_structure.h"

#include "base/stopwatch.h"
#include "gpu/device_state.h"
#include "gpu/timer.h"

#include <algorithm>
#include <cassert>

namespace strandlab {

struct AccelerationStructure::Implementation {
    std::shared_ptr<Buffer> storage;  // structures of one batch share it
    vk::raii::AccelerationStructureKHR handle{nullptr};
    uint64_t address = 0, bytes = 0;
};

AccelerationStructure::AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(AccelerationStructure&&) noexcept = default;
AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&&) noexcept = default;
AccelerationStructure::~AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

uint64_t AccelerationStructure::address() const { return implementation_->address; }
uint64_t AccelerationStructure::bytes() const { return implementation_->bytes; }

void BuildCost::add(const BuildCost& other) {
    upload_ms += other.upload_ms;
    build_ms += other.build_ms;
    compaction_ms += other.compaction_ms;
    input_bytes += other.input_bytes;
    scratch_bytes = std::max(scratch_bytes, other.scratch_bytes);  // one after the other
    peak_bytes = std::max(peak_bytes, kept_bytes + other.peak_bytes);
    built_bytes += other.built_bytes;
    kept_bytes += other.kept_bytes;
}

namespace {

using Type = vk::AccelerationStructureTypeKHR;
using Structure = std::unique_ptr<AccelerationStructure::Implementation>;

/// A structure at an offset (a multiple of 256) of a buffer.
Structure create_in(const Device& device, Type type, std::shared_ptr<Buffer> storage, uint64_t offset,
                    uint64_t bytes) {
    auto structure = std::make_unique<AccelerationStructure::Implementation>();
    structure->handle = vk::raii::AccelerationStructureKHR(
        device.state().device,
        vk::AccelerationStructureCreateInfoKHR({}, handle_of(*storage), offset, bytes, type));
    structure->storage = std::move(storage);
    structure->bytes = bytes;
    structure->address = device.state().device.getAccelerationStructureAddressKHR({*structure->handle});
    return structure;
}

Structure create(const Device& device, Type type, uint64_t bytes) {
    return create_in(device, type, std::make_shared<Buffer>(device, bytes, Buffer::Use::structure), 0, bytes);
}

/// What the structure would take after compaction.
uint64_t compacted_size(const DeviceState& state, const AccelerationStructure::Implementation& structure) {
    const vk::raii::QueryPool query(
        state.device, vk::QueryPoolCreateInfo({}, vk::QueryType::eAccelerationStructureCompactedSizeKHR, 1));
    state.run("asking for a compacted size", [&](const vk::raii::CommandBuffer& commands) {
        commands.resetQueryPool(*query, 0, 1);
        commands.writeAccelerationStructuresPropertiesKHR(
            *structure.handle, vk::QueryType::eAccelerationStructureCompactedSizeKHR, *query, 0);
    });
    return query
        .getResults<uint64_t>(0, 1, sizeof(uint64_t), sizeof(uint64_t),
                              vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
        .second.front();
}

/// Builds one geometry, timed alone; fills cost (but upload and input) and, where the input says so, the
/// compacted size.
Structure build(const Device& device, Type type, const vk::AccelerationStructureGeometryKHR& geometry,
                uint32_t count, const BottomLevelInput& input, BuildCost& cost, uint64_t* compacted_bytes) {
    const DeviceState& state = device.state();
    vk::BuildAccelerationStructureFlagsKHR flags =
        vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
    if (input.low_memory) flags |= vk::BuildAccelerationStructureFlagBitsKHR::eLowMemory;
    if (input.compact) flags |= vk::BuildAccelerationStructureFlagBitsKHR::eAllowCompaction;
    vk::AccelerationStructureBuildGeometryInfoKHR info(
        type, flags, vk::BuildAccelerationStructureModeKHR::eBuild, {}, {}, geometry);
    const auto sizes = state.device.getAccelerationStructureBuildSizesKHR(
        vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);
    Structure structure = create(device, type, sizes.accelerationStructureSize);
    const uint64_t alignment =
        std::max(1u, state.structure_limits.minAccelerationStructureScratchOffsetAlignment);
    const Buffer scratch(device, sizes.buildScratchSize + alignment, Buffer::Use::scratch);
    info.dstAccelerationStructure = *structure->handle;
    info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
    const vk::AccelerationStructureBuildRangeInfoKHR range(count, 0, 0, 0);
    const Timer timer(state);
    const auto run_once = [&] {
        state.run("building an acceleration structure", [&](const vk::raii::CommandBuffer& commands) {
            timer.begin(commands);
            commands.buildAccelerationStructuresKHR(info, &range);
            timer.end(commands);
            full_barrier(commands);
        });
        return timer.milliseconds();
    };
    for (double spent = 0; spent < input.warm_up_ms;) spent += std::max(1e-2, run_once());
    cost.build_ms = run_once();
    if (compacted_bytes != nullptr) *compacted_bytes = compacted_size(state, *structure);
    cost.scratch_bytes = sizes.buildScratchSize;
    cost.built_bytes = cost.kept_bytes = sizes.accelerationStructureSize;
    cost.peak_bytes = cost.input_bytes + cost.scratch_bytes + cost.built_bytes;
    return structure;
}

Structure compacted(const Device& device, Structure structure, uint64_t bytes, BuildCost& cost) {
    const DeviceState& state = device.state();
    Structure smaller = create(device, Type::eBottomLevel, bytes);
    const Timer timer(state);
    state.run("compacting an acceleration structure", [&](const vk::raii::CommandBuffer& commands) {
        timer.begin(commands);
        commands.copyAccelerationStructureKHR(
            {*structure->handle, *smaller->handle, vk::CopyAccelerationStructureModeKHR::eCompact});
        timer.end(commands);
        full_barrier(commands);
    });
    cost.compaction_ms = timer.milliseconds();
    cost.kept_bytes = bytes;
    cost.peak_bytes = std::max(cost.peak_bytes, cost.input_bytes + cost.built_bytes + bytes);
    return smaller;
}

vk::GeometryFlagsKHR geometry_flags(bool opaque) {
    return opaque ? vk::GeometryFlagBitsKHR::eOpaque : vk::GeometryFlagBitsKHR::eNoDuplicateAnyHitInvocation;
}

/// The instance record of the API: three rows of four.
vk::AccelerationStructureInstanceKHR instance_record(const InstanceInput& input) {
    vk::TransformMatrixKHR matrix;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            matrix.matrix[row][column] = input.world_from_object[column][row];
    vk::AccelerationStructureInstanceKHR record(matrix, input.custom_index & 0xFFFFFFu, 0xFFu, 0);
    record.accelerationStructureReference = input.structure;
    return record;
}

/// What is built of a batch: one geometry of so many leaves or instances.
struct BatchItem {
    vk::AccelerationStructureGeometryKHR geometry;
    uint32_t count = 0;
};

uint64_t round_up(uint64_t value, uint64_t alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

/// Where the structures of a batch and their scratch lie within the buffers that they share.
struct BatchLayout {
    std::vector<uint64_t> bytes, offsets, scratch_offsets;
    uint64_t total = 0, scratch_total = 0;
};

/// As many items from the front as share buffers of a size that every device gives.
BatchLayout lay_out(const DeviceState& state, Type type, std::span<const BatchItem> items) {
    constexpr uint64_t most = uint64_t(128) << 20;
    const uint64_t alignment =
        std::max(1u, state.structure_limits.minAccelerationStructureScratchOffsetAlignment);
    BatchLayout layout;
    for (const BatchItem& item : items) {
        const vk::AccelerationStructureBuildGeometryInfoKHR info(
            type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
            vk::BuildAccelerationStructureModeKHR::eBuild, {}, {}, item.geometry);
        const auto sizes = state.device.getAccelerationStructureBuildSizesKHR(
            vk::AccelerationStructureBuildTypeKHR::eDevice, info, item.count);
        if (!layout.bytes.empty() &&
            layout.total + sizes.accelerationStructureSize + layout.scratch_total + sizes.buildScratchSize >
                most)
            break;
        layout.bytes.push_back(sizes.accelerationStructureSize);
        layout.offsets.push_back(layout.total);
        layout.scratch_offsets.push_back(layout.scratch_total);
        layout.total += round_up(sizes.accelerationStructureSize, 256);
        layout.scratch_total += round_up(sizes.buildScratchSize, alignment);
    }
    layout.scratch_total += alignment;
    return layout;
}

/// Builds the items of a layout in one submission.
void build_together(const Device& device, Type type, std::span<const BatchItem> items,
                    const BatchLayout& layout, std::vector<AccelerationStructure>& built, BuildCost& total) {
    const DeviceState& state = device.state();
    const uint64_t alignment =
        std::max(1u, state.structure_limits.minAccelerationStructureScratchOffsetAlignment);
    const auto storage = std::make_shared<Buffer>(device, layout.total, Buffer::Use::structure);
    const Buffer scratch(device, layout.scratch_total, Buffer::Use::scratch);
    const uint64_t scratch_base = round_up(scratch.address(), alignment);
    std::vector<vk::AccelerationStructureBuildGeometryInfoKHR> infos;
    std::vector<vk::AccelerationStructureBuildRangeInfoKHR> ranges;
    for (size_t i = 0; i < items.size(); ++i) {
        Structure structure = create_in(device, type, storage, layout.offsets[i], layout.bytes[i]);
        auto& info =
            infos.emplace_back(type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
                               vk::BuildAccelerationStructureModeKHR::eBuild, vk::AccelerationStructureKHR{},
                               *structure->handle, items[i].geometry);
        info.scratchData.deviceAddress = scratch_base + layout.scratch_offsets[i];
        ranges.emplace_back(items[i].count, 0, 0, 0);
        built.emplace_back(std::move(structure));
    }
    std::vector<const vk::AccelerationStructureBuildRangeInfoKHR*> range_pointers;
    for (const auto& range : ranges) range_pointers.push_back(&range);
    const Timer timer(state);
    state.run("building acceleration structures", [&](const vk::raii::CommandBuffer& commands) {
        timer.begin(commands);
        commands.buildAccelerationStructuresKHR(infos, range_pointers);
        timer.end(commands);
        full_barrier(commands);
    });
    BuildCost cost;
    cost.build_ms = timer.milliseconds();
    cost.scratch_bytes = layout.scratch_total;
    cost.built_bytes = cost.kept_bytes = layout.total;
    cost.peak_bytes = cost.scratch_bytes + cost.built_bytes;
    total.add(cost);
}

std::vector<AccelerationStructure> build_batch(const Device& device, Type type,
                                               std::span<const BatchItem> items, BuildCost& cost) {
    std::vector<AccelerationStructure> built;
    built.reserve(items.size());
    while (!items.empty()) {
        const BatchLayout layout = lay_out(device.state(), type, items);
        build_together(device, type, items.first(layout.bytes.size()), layout, built, cost);
        items = items.subspan(layout.bytes.size());
    }
    return built;
}

/// The addresses of geometries in the buffers that a build reads.
vk::AccelerationStructureGeometryKHR box_geometry(uint64_t boxes) {
    vk::AccelerationStructureGeometryKHR geometry;
    geometry.geometryType = vk::GeometryTypeKHR::eAabbs;
    geometry.geometry.aabbs = vk::AccelerationStructureGeometryAabbsDataKHR(boxes, 6 * sizeof(float));
    return geometry;
}

vk::AccelerationStructureGeometryKHR triangle_geometry(uint64_t vertices, size_t vertex_count,
                                                       uint64_t indices) {
    vk::AccelerationStructureGeometryKHR geometry;
    geometry.geometryType = vk::GeometryTypeKHR::eTriangles;
    geometry.geometry.triangles = vk::AccelerationStructureGeometryTrianglesDataKHR(
        vk::Format::eR32G32B32Sfloat, vertices, sizeof(glm::vec3), static_cast<uint32_t>(vertex_count) - 1,
        vk::IndexType::eUint32, indices);
    return geometry;
}

vk::AccelerationStructureGeometryKHR instance_geometry(uint64_t instances) {
    vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eInstances);
    geometry.geometry.instances = vk::AccelerationStructureGeometryInstancesDataKHR(false, instances);
    return geometry;
}

Buffer upload_instances(const Device& device, std::span<const InstanceInput> instances) {
    std::vector<vk::AccelerationStructureInstanceKHR> records;
    records.reserve(instances.size());
    for (const InstanceInput& instance : instances) records.push_back(instance_record(instance));
    return make_buffer(device, std::span<const vk::AccelerationStructureInstanceKHR>(records),
                       Buffer::Use::build_input);
}

}  // namespace

AccelerationStructure build_bottom_level(const Device& device, const BottomLevelInput& input,
                                         BuildCost& total) {
    assert(input.leaf_count() > 0 && input.leaf_count() <= device.info().max_leaves);
    return guarded("building an acceleration structure", [&] {
        BuildCost cost;
        const Stopwatch stopwatch;
        vk::AccelerationStructureGeometryKHR geometry;
        Buffer boxes, vertices, indices;
        if (input.device_boxes != 0) {
            cost.input_bytes = input.device_box_count * 6 * sizeof(float);
            geometry = box_geometry(input.device_boxes);
        } else if (input.triangles.empty()) {
            boxes = make_buffer(device, input.boxes, Buffer::Use::build_input);
            cost.input_bytes = input.boxes.size_bytes();
            geometry = box_geometry(boxes.address());
        } else {
            vertices = make_buffer(device, input.vertices, Buffer::Use::build_input);
            indices = make_buffer(device, input.triangles, Buffer::Use::build_input);
            cost.input_bytes = input.vertices.size_bytes() + input.triangles.size_bytes();
            geometry = triangle_geometry(vertices.address(), input.vertices.size(), indices.address());
        }
        geometry.flags = geometry_flags(input.opaque);
        cost.upload_ms = stopwatch.milliseconds();
        uint64_t compacted_bytes = 0;
        Structure structure =
            build(device, Type::eBottomLevel, geometry, static_cast<uint32_t>(input.leaf_count()), input,
                  cost, input.compact ? &compacted_bytes : nullptr);
        if (compacted_bytes != 0 && compacted_bytes < cost.built_bytes)
            structure = compacted(device, std::move(structure), compacted_bytes, cost);
        total.add(cost);
        return AccelerationStructure(std::move(structure));
    });
}

AccelerationStructure build_top_level(const Device& device, std::span<const InstanceInput> instances,
                                      BuildCost& total) {
    return guarded("building the instances' acceleration structure", [&] {
        BuildCost cost;
        const Buffer input = upload_instances(device, instances);
        cost.input_bytes = input.size();
        Structure structure =
            build(device, Type::eTopLevel, instance_geometry(input.address()),
                  static_cast<uint32_t>(instances.size()), BottomLevelInput{.compact = false}, cost, nullptr);
        total.add(cost);
        return AccelerationStructure(std::move(structure));
    });
}

std::vector<AccelerationStructure> build_bottom_levels(const Device& device,
                                                       std::span<const BottomLevelInput> inputs,
                                                       BuildCost& cost) {
    return guarded("building acceleration structures", [&] {
        std::vector<float> all_boxes;
        std::vector<glm::uvec3> all_triangles;
        for (const BottomLevelInput& input : inputs) {
            all_boxes.insert(all_boxes.end(), input.boxes.begin(), input.boxes.end());
            all_triangles.insert(all_triangles.end(), input.triangles.begin(), input.triangles.end());
            assert(input.vertices.data() == inputs.front().vertices.data());
        }
        const auto vertices = inputs.empty() ? std::span<const glm::vec3>{} : inputs.front().vertices;
        const Buffer box_buffer =
            make_buffer(device, std::span<const float>(all_boxes), Buffer::Use::build_input);
        const Buffer vertex_buffer = make_buffer(device, vertices, Buffer::Use::build_input);
        const Buffer index_buffer =
            make_buffer(device, std::span<const glm::uvec3>(all_triangles), Buffer::Use::build_input);
        std::vector<BatchItem> items;
        uint64_t boxes = box_buffer.address(), indices = index_buffer.address();
        for (const BottomLevelInput& input : inputs) {
            BatchItem& item = items.emplace_back();
            item.geometry = input.triangles.empty()
                                ? box_geometry(boxes)
                                : triangle_geometry(vertex_buffer.address(), vertices.size(), indices);
            item.geometry.flags = geometry_flags(input.opaque);
            item.count = static_cast<uint32_t>(input.leaf_count());
            boxes += input.boxes.size_bytes();
            indices += input.triangles.size_bytes();
        }
        return build_batch(device, Type::eBottomLevel, items, cost);
    });
}

std::vector<AccelerationStructure> build_top_levels(const Device& device,
                                                    std::span<const InstanceInput> instances,
                                                    BuildCost& cost) {
    return guarded("building the instances' acceleration structures", [&] {
        const Buffer input = upload_instances(device, instances);
        std::vector<BatchItem> items;
        for (size_t i = 0; i < instances.size(); ++i)
            items.push_back(
                {instance_geometry(input.address() + i * sizeof(vk::AccelerationStructureInstanceKHR)), 1});
        return build_batch(device, Type::eTopLevel, items, cost);
    });
}

}  // namespace strandlab
