#version 460
#extension GL_GOOGLE_include_directive : require
// The nearest hit of the triangle strips: the curve parameter from the barycentrics, and from the joints'
// records the normal and the round place of the hit. A hit that moves keeps the triangle's place in
// traversal; only what is written moves.
#include "shared/trace.glsl"
#include "shared/portable.h"
#include "primitives/dots.h"

layout(constant_id = 16) const uint round_normals = 1;
layout(constant_id = 17) const uint round_offset = 0;
layout(constant_id = 18) const float width_factor = 1.0;

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer IndexBuffer { uint items[]; };

// The shading records begin with one index a curve: the record of its first joint.
DotsJoint fetch_joint(GeometryRow row, uint index) {
    Vec4Buffer records = Vec4Buffer(row.shading_records);
    return dots_joint(records.items[2u * index], records.items[2u * index + 1u]);
}

Hit finish_hit(GeometryRow row, Leaf leaf, vec2 barycentrics, vec3 direction, float tmin, float t,
               out vec3 normal) {
    uint quad = (leaf_flags(leaf) >> 2) & 1u;
    uint triangle = (leaf_flags(leaf) >> 3) & 1u;
    float along = dots_along(barycentrics, triangle);
    if (wants_normals || round_offset != 0u) {
        uint start = IndexBuffer(row.shading_records).items[leaf.curve] + leaf_piece(leaf);
        dots_finish(direction, tmin, fetch_joint(row, start), fetch_joint(row, start + 1u), quad, triangle,
                    barycentrics, width_factor, round_normals != 0u, round_offset != 0u, t, along, normal);
    }
    float u = (float(leaf_piece(leaf)) + along) / float(leaf_pieces(leaf));
    return Hit(t, u, row.first_curve + leaf.curve, row.instance);
}

#include "shared/triangle_entry.glsl"
