#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_buffer_reference_uvec2 : require
// What this device's arithmetic does with what the ray frame relies on (source/gpu/arithmetic.h).
#include "shared/portable.h"
#include "shared/ray_frame.h"

layout(local_size_x = 64) in;

struct Probe {
    vec4 origin;      // a factor in w
    vec4 direction;   // - fl(factor * direction.x) in w
    vec4 reference;   // a base in w
    vec4 middle;      // - fl(base^2)
};

struct Answer {
    vec4 fma_residue;     // of the products factor * direction; w: direction.x * factor + direction.w
    vec4 dekker_residue;  // of the same; w: t of the frame's foot
    vec4 foot;            // of the ray frame
    vec4 plain_foot;      // the same without its corrections; w: base^2 + middle.w, free to be contracted
    vec4 rounded;         // factor / direction.x, sqrt(factor)
};

layout(buffer_reference, std430, buffer_reference_align = 16) readonly buffer ProbeBuffer { Probe items[]; };
layout(buffer_reference, std430, buffer_reference_align = 16) writeonly buffer AnswerBuffer { Answer items[]; };

layout(push_constant) uniform PushConstants {
    uvec2 probes;
    uvec2 answers;
    uint count;
};

// A function of its own: the compiler marks what is near to something precise.
float loose_square_sum(float base, float minus_square) { return base * base + minus_square; }

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    Probe probe = ProbeBuffer(probes).items[index];
    float factor = probe.origin.w;
    vec3 direction = probe.direction.xyz;
    precise vec3 product = direction * factor;
    precise vec3 fma_residue = fma(vec3(factor), direction, -product);
    precise float sum = direction.x * factor + probe.direction.w;
    float loose_sum = loose_square_sum(probe.reference.w, probe.middle.w);
    RayFrame frame = make_ray_frame(probe.origin.xyz, direction, probe.reference.xyz, probe.middle.xyz);
    precise vec3 plain_foot = (probe.origin.xyz - probe.reference.xyz) + direction * frame.t_foot;
    Answer answer;
    answer.fma_residue = vec4(fma_residue, sum);
    answer.dekker_residue = vec4(product_error(factor, direction, product), frame.t_foot);
    answer.foot = vec4(frame.foot, 0.0);
    answer.plain_foot = vec4(plain_foot, loose_sum);
    answer.rounded = vec4(factor / direction.x, sqrt(factor), 0.0, 0.0);
    AnswerBuffer(answers).items[index] = answer;
}
