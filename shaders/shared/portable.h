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
// Before loops whose copies would cost registers and instruction cache.
#define ROLLED [[dont_unroll]]
#ifndef COUNT_ITERATION
#define COUNT_ITERATION  // what traces rays counts them (shared/trace.glsl)
#endif

// Set only where the arithmetic probe (source/gpu/arithmetic.h) has shown that fma rounds once.
layout(constant_id = 15) const bool hardware_fma = false;

const float real_splitter = 4097.0;  // 2^12 + 1, Dekker's constant for 24-bit significands
const float real_epsilon = 1.1920929e-7;

#endif
