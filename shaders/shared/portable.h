// Makes one text legal in GLSL and in C++. Code headers (intersectors, frames) include nothing: in GLSL
// the entry file includes this first; in C++ source/primitives/kernel.h does the same work for float and
// double. Rules: no swizzles but .x .y .z .w, real3(v) to convert, no array parameters, OUT(T) for results,
// real(...) literals, loops with constant bounds, comparisons written so that NaN is a miss.
#ifndef STRANDLAB_PORTABLE_H
#define STRANDLAB_PORTABLE_H

#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define OUT(T) out T
#define INOUT(T) inout T
// Every local of a function with error-free transformations carries the mark: it does not reach callees.
#define PRECISE precise
#define FUNCTION
// A function that few leaves need: out of the way of what all need.
#define SELDOM
// Before loops whose copies would cost registers and instruction cache.
#define ROLLED [[dont_unroll]]
#ifndef COUNT_ITERATION
#define COUNT_ITERATION  // what traces rays counts them (shared/trace.glsl)
#endif

// Functions whose roundings GLSL leaves open, as GLM has them.
float glm_dot(vec2 a, vec2 b) {
    vec2 p = a * b;
    return p.x + p.y;
}
float glm_dot(vec3 a, vec3 b) {
    vec3 p = a * b;
    return p.x + p.y + p.z;
}
vec3 glm_cross(vec3 a, vec3 b) { return a.yzx * b.zxy - b.yzx * a.zxy; }
vec3 glm_normalize(vec3 v) { return v * (1.0 / sqrt(glm_dot(v, v))); }
float glm_mix(float a, float b, float u) { return a * (1.0 - u) + b * u; }
vec4 glm_mix(vec4 a, vec4 b, float u) { return a * (1.0 - u) + b * u; }
vec4 native_mix(vec4 a, vec4 b, float u) { return mix(a, b, u); }  // the driver's own
#define dot glm_dot
#define cross glm_cross
#define normalize glm_normalize
#define mix glm_mix

// Set only where the arithmetic probe (source/gpu/arithmetic.h) has shown that fma rounds once.
layout(constant_id = 15) const bool hardware_fma = false;

const float real_splitter = 4097.0;  // 2^12 + 1, Dekker's constant for 24-bit significands
const float real_epsilon = 1.1920929e-7;

#endif
