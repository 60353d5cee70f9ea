// Bottom- and top-level acceleration structures: building, compacting, what they cost.
#pragma once

#include "gpu/device.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace strandlab {

/// Geometry of one bottom-level structure, on the host: boxes (6 floats each: low, high), or triangles; or
/// boxes on the device (build_bottom_level alone).
struct BottomLevelInput {
    std::span<const float> boxes;
    uint64_t device_boxes = 0;  // not 0: their address; device_box_count of them
    size_t device_box_count = 0;
    std::span<const glm::vec3> vertices;
    std::span<const glm::uvec3> triangles;
    bool opaque = true;
    bool compact = true;
    bool low_memory = false;  // smaller, and slower to trace, where the driver can
    double warm_up_ms = 0;  // device time to spend on the same build before it is timed: an idle GPU is slow

    size_t leaf_count() const {
        if (device_boxes != 0) return device_box_count;
        return triangles.empty() ? boxes.size() / 6 : triangles.size();
    }
};

/// Times and sizes of builds; added up over the structures of a scene. Sizes are what the driver says.
struct BuildCost {
    double upload_ms = 0;      // host clock: input to the device
    double build_ms = 0;       // device clock
    double compaction_ms = 0;  // device clock
    uint64_t input_bytes = 0;  // boxes, or vertices and indices: needed at build only
    uint64_t scratch_bytes = 0;
    uint64_t built_bytes = 0;  // before compaction
    uint64_t kept_bytes = 0;   // while tracing
    uint64_t peak_bytes = 0;   // the most at any moment of the builds, of all of the above

    void add(const BuildCost& other);
};

/// A built structure. Movable.
class AccelerationStructure {
  public:
    AccelerationStructure();
    AccelerationStructure(AccelerationStructure&&) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&&) noexcept;
    ~AccelerationStructure();

    /// Device address, for instances and for shaders.
    uint64_t address() const;
    uint64_t bytes() const;

    struct Implementation;
    explicit AccelerationStructure(std::unique_ptr<Implementation> implementation);

  private:
    std::unique_ptr<Implementation> implementation_;
};

/// One instance: world_from_object as four columns, the structure, and the custom index that shaders see.
struct InstanceInput {
    glm::mat4x3 world_from_object{1.0f};
    uint64_t structure = 0;
    uint32_t custom_index = 0;  // 24 bits
};

/// Builds (prefer fast trace) and, if asked, compacts. Errors: device_lost when memory runs out.
AccelerationStructure build_bottom_level(const Device& device, const BottomLevelInput& input,
                                         BuildCost& cost);

/// Builds the structure over instances of built structures.
AccelerationStructure build_top_level(const Device& device, std::span<const InstanceInput> instances,
                                      BuildCost& cost);

/// Many small structures at once, in a few submissions and allocations, which they share. Not compacted.
/// Inputs of triangles must have one and the same vertices.
std::vector<AccelerationStructure> build_bottom_levels(const Device& device,
                                                       std::span<const BottomLevelInput> inputs,
                                                       BuildCost& cost);

/// Top-level structures of one instance each.
std::vector<AccelerationStructure> build_top_levels(const Device& device,
                                                    std::span<const InstanceInput> instances,
                                                    BuildCost& cost);

}  // namespace strandlab
