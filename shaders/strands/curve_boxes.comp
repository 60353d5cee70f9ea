#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Boxes of curves that lie on the device, as source/scene/bounds.h makes them, but in float with wider margins.
#include "strands/box_parameters.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform PushConstants { BoxParameters parameters; };

layout(buffer_reference, std430, buffer_reference_align = 16) buffer PointBuffer { vec4 items[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) writeonly buffer BoxBuffer { float items[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Counter { uint value; };

const float ulp = 1.1920929e-7;  // of 1; that of x is at most x ulp
// Evaluation in float takes up to 8 ulp, the place of an extremum less than one.
const float evaluation_ulps = 16.0;
const float padding_ulps = 4.0;

float value_at(vec4 c, float u) {
    float v = 1.0 - u;
    return v * v * (v * c.x + 3.0 * u * c.y) + u * u * (3.0 * v * c.z + u * c.w);
}

// Least and largest value on [a, b] of the cubic with these Bezier coefficients.
vec2 range_of(vec4 c, float a, float b) {
    float at_a = value_at(c, a);
    float at_b = value_at(c, b);
    vec2 range = vec2(min(at_a, at_b), max(at_a, at_b));
    float d0 = c.y - c.x;
    float d1 = c.z - c.y;
    float d2 = c.w - c.z;
    float quadratic = d0 - 2.0 * d1 + d2;
    float linear = d1 - d0;
    float discriminant = linear * linear - quadratic * d0;
    // A rounded discriminant may be negative where there is a double root: flat enough for either answer.
    float q = -(linear + (linear < 0.0 ? -1.0 : 1.0) * sqrt(max(discriminant, 0.0)));
    float first = q / quadratic;
    float second = d0 / q;
    if (first > a && first < b) {
        float value = value_at(c, first);
        range = vec2(min(range.x, value), max(range.y, value));
    }
    if (second > a && second < b) {
        float value = value_at(c, second);
        range = vec2(min(range.x, value), max(range.y, value));
    }
    return range;
}

// The curve's polar form.
vec3 blossom(vec4 c[4], float r, float s, float t) {
    vec3 ab = mix(c[0].xyz, c[1].xyz, r);
    vec3 bc = mix(c[1].xyz, c[2].xyz, r);
    vec3 cd = mix(c[2].xyz, c[3].xyz, r);
    return mix(mix(ab, bc, s), mix(bc, cd, s), t);
}

// Whether the control polygon of the piece turns by more than a right angle in all: cos(alpha + beta) < 0.
bool turns(vec4 c[4], float a, float b) {
    vec3 p1 = blossom(c, a, a, b);
    vec3 p2 = blossom(c, a, b, b);
    vec3 first = p1 - blossom(c, a, a, a);
    vec3 second = p2 - p1;
    vec3 third = blossom(c, b, b, b) - p2;
    float alpha = dot(first, second);
    float beta = dot(second, third);
    return !(alpha >= 0.0 && beta >= 0.0) ||
           alpha * beta < length(cross(first, second)) * length(cross(second, third));
}

void main() {
    uint index = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    if (index >= parameters.curve_count) return;
    PointBuffer points = PointBuffer(parameters.curves);
    vec4 c[4];
    for (uint i = 0u; i < 4u; ++i) c[i] = points.items[4u * index + i];
    vec3 reach = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i) reach = max(reach, abs(c[i].xyz) + c[i].w);
    float largest = max(max(reach.x, reach.y), reach.z);
    BoxBuffer boxes = BoxBuffer(parameters.boxes);
    uint turning = 0u;
    for (uint piece = 0u; piece < parameters.splits; ++piece) {
        float a = float(piece) / float(parameters.splits);
        float b = float(piece + 1u) / float(parameters.splits);
        for (uint axis = 0u; axis < 3u; ++axis) {
            vec4 position = vec4(c[0][axis], c[1][axis], c[2][axis], c[3][axis]);
            vec4 radius = vec4(c[0].w, c[1].w, c[2].w, c[3].w);
            float margin = evaluation_ulps * ulp * reach[axis] +
                           padding_ulps * ulp * (1.001 * largest + parameters.extent);
            uint at = 6u * (parameters.splits * index + piece) + axis;
            boxes.items[at] = range_of(position - radius, a, b).x - margin;
            boxes.items[at + 3u] = range_of(position + radius, a, b).y + margin;
        }
        if (turns(c, a, b)) ++turning;
    }
    if (turning > 0u) atomicAdd(Counter(parameters.turning).value, turning);
    if (parameters.marks_ends == 0u) return;
    uint place = index % parameters.curves_per_strand;
    if (place == 0u) points.items[4u * index].w = uintBitsToFloat(floatBitsToUint(c[0].w) | 0x80000000u);
    if (place + 1u == parameters.curves_per_strand)
        points.items[4u * index + 3u].w = uintBitsToFloat(floatBitsToUint(c[3].w) | 0x80000000u);
}
