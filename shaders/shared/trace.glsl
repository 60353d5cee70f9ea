// What every ray-tracing stage needs: the push constants, the tables they address, the payload. With RAY_QUERY
// the same for a compute shader that traces by ray queries (shared/query.glsl).
#ifndef STRANDLAB_TRACE_GLSL
#define STRANDLAB_TRACE_GLSL

#ifdef RAY_QUERY
#extension GL_EXT_ray_query : require
#else
#extension GL_EXT_ray_tracing : require
#endif
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shared/leaf.h"
#include "shared/trace_parameters.h"

layout(push_constant) uniform PushConstants { TraceParameters parameters; };

// Specialization constants of all primitives (ids below 16); those of one primitive start at 16.
layout(constant_id = 0) const bool has_leaf_table = true;  // else leaf i is piece i % n of curve i / n
layout(constant_id = 1) const bool wants_normals = false;
layout(constant_id = 2) const uint curves_of_a_ray = 0u;  // not 0: ray i meets curves [i n, (i + 1) n) alone
layout(constant_id = 3) const uint uniform_pieces = 0u;   // not 0: pieces of every curve, else in the row
layout(constant_id = 4) const bool has_one_row = false;   // then it lies in the push constants
layout(constant_id = 5) const bool is_in_place = false;   // no instance is moved
layout(constant_id = 6) const bool early_out = true;      // leave what a ray passes before anything else
layout(constant_id = 7) const bool gentle_first = true;   // the short way for rays that cross a piece gently
layout(constant_id = 8) const bool counts_work = false;   // for profiles only: never where time is measured
layout(constant_id = 9) const bool blocks_of_lanes = false;  // pictures on processors: see ray_index
layout(constant_id = 10) const uint strand_curves = 0u;   // not 0: each strand's, which share the points they meet in

struct Ray {
    vec3 origin;
    float tmin;
    vec3 direction;
    float tmax;
};

struct Hit {
    float t;
    float u;
    uint curve;
    uint instance;
};

struct TracePayload {
    Hit hit;
    vec3 normal;
};

const uint no_curve = 0xFFFFFFFFu;

Hit miss() { return Hit(uintBitsToFloat(0x7F800000u), 0.0, no_curve, 0u); }

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer RayBuffer { Ray items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer HitBuffer { Hit items[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) writeonly buffer FloatBuffer { float items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer RowBuffer { GeometryRow items[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer LeafBuffer { Leaf items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer Vec4Buffer { vec4 items[]; };

layout(buffer_reference, std430, buffer_reference_align = 4) buffer CounterBuffer { uint items[]; };

GeometryRow fetch_row(uint custom_index) {
    if (has_one_row) return parameters.row;
    return RowBuffer(parameters.rows).items[custom_index];
}

// The leaf behind a primitive index of the current acceleration structure.
Leaf fetch_leaf(GeometryRow row, uint primitive) {
    if (has_leaf_table) return LeafBuffer(row.leaves).items[row.first_leaf + primitive];
    uint index = row.first_leaf + primitive;
    uint pieces = uniform_pieces != 0u ? uniform_pieces : row.pieces;
    return Leaf(index / pieces, (index % pieces) | (pieces << 12));
}

// Where the control points of a curve begin.
uint first_point(uint curve) {
    return strand_curves == 0u ? 4u * curve : 3u * curve + curve / strand_curves;
}

// The parameters between which the leaf's piece lies. Quotients by a power of two are exact products.
vec2 leaf_interval(Leaf leaf) {
    float first = float(leaf_piece(leaf));
    if (uniform_pieces != 0u && (uniform_pieces & (uniform_pieces - 1u)) == 0u)
        return vec2(first, first + 1.0) * (1.0 / float(uniform_pieces));
    return vec2(first, first + 1.0) / float(leaf_pieces(leaf));
}

// Index of the current ray within its buffer.
#ifdef RAY_QUERY
uint query_ray;
uint ray_index() { return query_ray; }
#else
uint ray_index() {
    uvec2 place = gl_LaunchIDEXT.xy;
    if (blocks_of_lanes && parameters.is_tiled != 0u) {
        // Eight neighbours in a row become four by two, where both rows and all eight columns are there.
        uvec2 corner = uvec2(place.x & ~7u, place.y & ~1u);
        if (corner.x + 8u <= gl_LaunchSizeEXT.x && corner.y + 2u <= gl_LaunchSizeEXT.y)
            place = corner + uvec2(((place.y & 1u) << 2) | (place.x & 3u), (place.x >> 2) & 1u);
    }
    return parameters.first_ray + place.y * gl_LaunchSizeEXT.x + place.x;
}
#endif

// Whether the leaf belongs to another ray's curves.
bool is_foreign(GeometryRow row, Leaf leaf) {
    return curves_of_a_ray != 0u && (row.first_curve + leaf.curve) / curves_of_a_ray != ray_index();
}

// Iterations of an intersector's search on the current leaf.
uint iteration_count = 0u;
#define COUNT_ITERATION \
    if (counts_work) ++iteration_count;

// Adds a leaf to the ray's counters: leaves, those that were searched, iterations, hits reported.
void count_leaf(bool is_reported) {
    if (!counts_work) return;
    CounterBuffer counters = CounterBuffer(parameters.counters);
    uint first = 4u * ray_index();
    atomicAdd(counters.items[first], 1u);
    atomicAdd(counters.items[first + 1u], iteration_count > 0u ? 1u : 0u);
    atomicAdd(counters.items[first + 2u], iteration_count);
    atomicAdd(counters.items[first + 3u], is_reported ? 1u : 0u);
    iteration_count = 0u;
}

#endif
