// What the shaders that grow strands share: the tables on the device, a strand's face and place on it.
#ifndef STRANDLAB_GROWTH_GLSL
#define STRANDLAB_GROWTH_GLSL

#include "shared/portable.h"
#include "strands/grow_parameters.h"
#include "strands/hair_strand.h"
#include "strands/root_place.h"
#include "strands/strand_curve.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform PushConstants { GrowthParameters parameters; };

layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer TablesBuffer { GrowthTables tables; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer FaceBuffer { GrowthFace items[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Numbers { float items[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer StyleBuffer { StrandStyle style; };
layout(buffer_reference, std430, buffer_reference_align = 16) buffer PointBuffer { vec4 items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer CurveBuffer { CurveRecord items[]; };

vec2 pair_at(uvec2 buffer_address, uint index) {
    Numbers numbers = Numbers(buffer_address);
    return vec2(numbers.items[2 * index], numbers.items[2 * index + 1]);
}

vec3 triple_at(uvec2 buffer_address, uint index) {
    Numbers numbers = Numbers(buffer_address);
    return vec3(numbers.items[3 * index], numbers.items[3 * index + 1], numbers.items[3 * index + 2]);
}

// The last face whose strands begin at or before this one: faces without strands are passed over.
uint face_of(GrowthTables tables, uint strand) {
    uint low = 0u;
    uint high = tables.face_count;
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (FaceBuffer(tables.faces).items[middle].first_strand <= strand) low = middle;
        else high = middle;
    }
    return low;
}

// Root of strand `index` of a face.
vec2 root_of(GrowthTables tables, GrowthFace face, uint face_id, uint index) {
    bool is_triangle = face.is_triangle != 0u;
    uint set = is_triangle ? 1u : 0u;
    uint round_number = index / tables.sample_count;
    vec2 stored = pair_at(tables.samples, set * tables.sample_count + index % tables.sample_count);
    vec2 shift = pair_at(tables.shifts, 2u * round_number + set);
    return placed_sample(stored, shift, round_number == 0u, is_triangle, combine(face_id, 14u));
}

// Item `index` of `count` a column, blended.
vec3 blended(uvec2 items, uint count, uint index, GrowthFace face, vec4 weights) {
    return blend(triple_at(items, face.corners[0] * count + index), triple_at(items, face.corners[1] * count + index),
                 triple_at(items, face.corners[2] * count + index), triple_at(items, face.corners[3] * count + index),
                 weights);
}

#endif
