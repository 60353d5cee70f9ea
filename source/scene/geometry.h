// What a primitive builds and a builder turns into acceleration structures: plain data.
#pragma once

#include "scene/bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace strandlab {

/// Which part of which curve a leaf (a box or a triangle) stands for. Layout as shaders/shared/leaf.h.
struct Leaf {
    uint32_t curve = 0;     // index within the model
    uint32_t interval = 0;  // packed by pack_interval

    static constexpr uint32_t max_pieces = 4095;
    /// Flag bits 0..7 of a leaf; the rest are the primitive's own.
    static constexpr uint32_t begins_strand = 1, ends_strand = 2;

    /// Piece i of n equal parameter intervals: u in [i/n, (i+1)/n].
    static constexpr uint32_t pack_interval(uint32_t piece, uint32_t pieces, uint32_t flags = 0) {
        return piece | (pieces << 12) | (flags << 24);
    }
    constexpr uint32_t piece() const { return interval & 4095u; }
    constexpr uint32_t pieces() const { return (interval >> 12) & 4095u; }
    constexpr uint32_t flags() const { return interval >> 24; }
};
static_assert(sizeof(Leaf) == 8);

/// A buffer of equal records that a shader reads.
struct Records {
    std::vector<std::byte> bytes;
    uint32_t stride = 0;  // bytes of one record; 0: none
    /// Bytes at the end of a record that shaders can find at the beginning of the next one, where they are
    /// the same (scene/shared_records.h); 0: none.
    uint32_t overlap = 0;

    size_t size() const { return stride == 0 ? 0 : bytes.size() / stride; }
};

/// Value of a specialization constant: (id, bits). Ids below 16 belong to shaders/shared/constants.h.
using Constant = std::pair<uint32_t, uint32_t>;

/// The geometry of one model for one primitive: boxes or triangles, and what its shaders read.
/// Leaf i is boxes[i], or triangles[i]; leaves[i] and leaf_records[i] belong to it.
struct Geometry {
    std::vector<Box> boxes;
    std::vector<glm::vec3> vertices;
    std::vector<glm::uvec3> triangles;
    std::vector<Leaf> leaves;
    Records leaf_records;     // one per leaf, in leaf order (or none)
    Records curve_records;    // one per curve, or what Leaf::curve selects (or none)
    Records shading_records;  // read only when normals are asked for (or none), or always_shades is set
    bool always_shades = false;

    /// When not 0: leaf i is piece i % n of n of curve i / n and has no flags, so that a shader can
    /// compute the leaf from its index and the table need not be stored.
    uint32_t uniform_pieces = 0;

    /// Specialization constants of this primitive's shaders (ids from 16), the same for its C++ text.
    std::vector<Constant> constants;

    bool is_triangles() const { return !triangles.empty(); }
    size_t leaf_count() const { return leaves.size(); }
    /// Value of a constant that the primitive has set.
    uint32_t constant(uint32_t id) const {
        for (const auto& [key, value] : constants)
            if (key == id) return value;
        return 0;
    }
};

/// Boxes of all leaves (computed from the vertices for triangles).
std::vector<Box> leaf_boxes(const Geometry& geometry);

/// Puts leaves, leaf records and boxes or triangles into the given order (order[i] = old index of
/// the new leaf i). Clears uniform_pieces unless the order changes nothing.
void reorder_leaves(Geometry& geometry, const std::vector<uint32_t>& order);

}  // namespace strandlab
