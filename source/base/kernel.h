// The C++ half of shaders/shared/portable.h. A kernel is a struct template on the scalar type that
// includes the code headers inside itself, so that one text gives the float and the double version:
//
//     template <class real> struct LssKernel {
//         STRANDLAB_KERNEL_TYPES
//     #include "shaders/shared/ray_frame.h"
//     #include "shaders/primitives/lss.h"
//     };
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#define OUT(T) T&
#define INOUT(T) T&
#define PRECISE
// Inlined whatever its size: the compiler would call the early-out, which every leaf needs, and inline the
// search behind it, whose registers every leaf would then save.
#define FUNCTION [[gnu::always_inline]] static inline
#define SELDOM [[gnu::noinline]] static
#define ROLLED
// One iteration of a search. Kernels that can be asked for their iterations have a second template parameter
// `bool counts`; without it the line is gone.
#define COUNT_ITERATION \
    if constexpr (counts) ++iteration_count;

// real3(v) converts and real3(x, y, z) constructs, as in GLSL.
#define STRANDLAB_KERNEL_TYPES                                                                        \
    using real2 = glm::vec<2, real>;                                                                  \
    using real3 = glm::vec<3, real>;                                                                  \
    using real4 = glm::vec<4, real>;                                                                  \
    using uint = uint32_t;                                                                            \
    static constexpr bool hardware_fma = false;                                                       \
    static constexpr real real_splitter = std::is_same_v<real, float> ? real(4097) : real(134217729); \
    static constexpr real real_epsilon = std::numeric_limits<real>::epsilon();

namespace strandlab::kernels {

/// Iterations of counting kernels on this thread.
inline thread_local uint32_t iteration_count = 0;

// The functions of GLSL that kernels use, for scalars and vectors.
using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::fma;  // not fused, and never called: hardware_fma is false
using glm::inversesqrt;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::sign;
using glm::sqrt;

template <class Vector, class Real>
Vector native_mix(const Vector& a, const Vector& b, Real u) {
    return glm::mix(a, b, u);
}

}  // namespace strandlab::kernels
