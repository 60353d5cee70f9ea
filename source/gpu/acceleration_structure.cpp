#include "gpu/acceleration_structure.h"

#include "base/stopwatch.h"
#include "gpu/device_state.h"
#include "gpu/timer.h"

#include <algorithm>
#include <cassert>

namespace strandlab {

struct AccelerationStructure::Implementation {
    Buffer storage;
    vk::raii::AccelerationStructureKHR handle{nullptr};
    uint64_t address = 0;
};

AccelerationStructure::AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(AccelerationStructure&&) noexcept = default;
AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&&) noexcept = default;
AccelerationStructure::~AccelerationStructure() = default;
AccelerationStructure::AccelerationStructure(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}

uint64_t AccelerationStructure::address() const { return implementation_->address; }
uint64_t AccelerationStructure::bytes() const { return implementation_->storage.size(); }

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

Structure create(const Device& device, Type type, uint64_t bytes) {
    auto structure = std::make_unique<AccelerationStructure::Implementation>();
    structure->storage = Buffer(device, bytes, Buffer::Use::structure);
    structure->handle = vk::raii::AccelerationStructureKHR(
        device.state().device,
        vk::AccelerationStructureCreateInfoKHR({}, handle_of(structure->storage), 0, bytes, type));
    structure->address = device.state().device.getAccelerationStructureAddressKHR({*structure->handle});
    return structure;
}

/// Builds one geometry; fills cost (but upload and input) and, where asked, the compacted size.
Structure build(const Device& device, Type type, const vk::AccelerationStructureGeometryKHR& geometry,
                uint32_t count, bool compactable, BuildCost& cost, uint64_t* compacted_bytes) {
    const DeviceState& state = device.state();
    vk::BuildAccelerationStructureFlagsKHR flags =
        vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace;
    if (compactable) flags |= vk::BuildAccelerationStructureFlagBitsKHR::eAllowCompaction;
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
    const vk::raii::QueryPool query(
        state.device, vk::QueryPoolCreateInfo({}, vk::QueryType::eAccelerationStructureCompactedSizeKHR, 1));
    state.run("building an acceleration structure", [&](const vk::raii::CommandBuffer& commands) {
        timer.begin(commands);
        commands.buildAccelerationStructuresKHR(info, &range);
        timer.end(commands);
        full_barrier(commands);
        if (compacted_bytes == nullptr) return;
        commands.resetQueryPool(*query, 0, 1);
        commands.writeAccelerationStructuresPropertiesKHR(
            *structure->handle, vk::QueryType::eAccelerationStructureCompactedSizeKHR, *query, 0);
    });
    if (compacted_bytes != nullptr)
        *compacted_bytes =
            query
                .getResults<uint64_t>(0, 1, sizeof(uint64_t), sizeof(uint64_t),
                                      vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
                .second.front();
    cost.build_ms = timer.milliseconds();
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

}  // namespace

AccelerationStructure build_bottom_level(const Device& device, const BottomLevelInput& input,
                                         BuildCost& total) {
    assert(input.leaf_count() > 0 && input.leaf_count() <= device.info().max_leaves);
    return guarded("building an acceleration structure", [&] {
        BuildCost cost;
        const Stopwatch stopwatch;
        vk::AccelerationStructureGeometryKHR geometry;
        geometry.flags = geometry_flags(input.opaque);
        Buffer boxes, vertices, indices;
        if (input.triangles.empty()) {
            boxes = make_buffer(device, input.boxes, Buffer::Use::build_input);
            cost.input_bytes = input.boxes.size_bytes();
            geometry.geometryType = vk::GeometryTypeKHR::eAabbs;
            geometry.geometry.aabbs =
                vk::AccelerationStructureGeometryAabbsDataKHR(boxes.address(), 6 * sizeof(float));
        } else {
            vertices = make_buffer(device, input.vertices, Buffer::Use::build_input);
            indices = make_buffer(device, input.triangles, Buffer::Use::build_input);
            cost.input_bytes = input.vertices.size_bytes() + input.triangles.size_bytes();
            geometry.geometryType = vk::GeometryTypeKHR::eTriangles;
            geometry.geometry.triangles = vk::AccelerationStructureGeometryTrianglesDataKHR(
                vk::Format::eR32G32B32Sfloat, vertices.address(), sizeof(glm::vec3),
                static_cast<uint32_t>(input.vertices.size()) - 1, vk::IndexType::eUint32, indices.address());
        }
        cost.upload_ms = stopwatch.milliseconds();
        uint64_t compacted_bytes = 0;
        Structure structure =
            build(device, Type::eBottomLevel, geometry, static_cast<uint32_t>(input.leaf_count()),
                  input.compact, cost, input.compact ? &compacted_bytes : nullptr);
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
        std::vector<vk::AccelerationStructureInstanceKHR> records;
        records.reserve(instances.size());
        for (const InstanceInput& instance : instances) records.push_back(instance_record(instance));
        const Buffer input = make_buffer(
            device, std::span<const vk::AccelerationStructureInstanceKHR>(records), Buffer::Use::build_input);
        cost.input_bytes = records.size() * sizeof(records[0]);
        vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eInstances);
        geometry.geometry.instances =
            vk::AccelerationStructureGeometryInstancesDataKHR(false, input.address());
        Structure structure = build(device, Type::eTopLevel, geometry, static_cast<uint32_t>(records.size()),
                                    false, cost, nullptr);
        total.add(cost);
        return AccelerationStructure(std::move(structure));
    });
}

}  // namespace strandlab
