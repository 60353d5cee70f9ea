// Disjoint orthogonal triangle strips: two crossed quads, four triangles, per straight piece of a curve.
#pragma once

#include "primitives/primitive.h"

namespace strandlab {

/// One joint of the strips as the closest-hit shader reads it (32 bytes): a point of the centre line with
/// its radius, and the unit quaternion (x, y, z, w) that turns the x and y axes into the axes of the two
/// strips. The strips reach half_width_factor x radius to both sides of the centre line.
///
/// Geometry::shading_records holds, in 32-byte records: first one uint32 per curve (filled up to whole
/// records), the index of the record of the curve's first joint; then the joints of all strands. Piece i
/// of a curve runs from joint first + i to joint first + i + 1.
///
/// Joint j of all strands owns the vertices 4 j .. 4 j + 3: centre - axis 0, centre + axis 0, centre -
/// axis 1, centre + axis 1 (axes times the half width). Strips share them along a strand, so joints are
/// closed; a strand whose curves do not meet begins a new joint where they part.
struct DotsJointRecord {
    glm::vec4 place;
    glm::vec4 rotation;
};
static_assert(sizeof(DotsJointRecord) == 32);

/// Half width of a strip in radii for which the mean projected width of two orthogonal strips, over the
/// view directions around the strand, is the diameter: the wider strip shows 2 w max(|cos|, |sin|), whose
/// mean is 2 w (2 sqrt 2 / pi).
inline constexpr double projected_half_width = 1.1107207345395915;  // pi / (2 sqrt 2)

/// A leaf's flags hold, besides the ends of the strand, which strip and which triangle of its quad.
inline constexpr uint32_t dots_quad_bit = 4, dots_triangle_bit = 8;

Primitive dots();

}  // namespace strandlab
