// What layout headers are written with: structs that GLSL and C++ (namespace strandlab::layout) share.
// Addresses are uvec2 in GLSL, so that no 64-bit integer feature is needed.
#ifndef STRANDLAB_LAYOUT_H
#define STRANDLAB_LAYOUT_H

#ifdef __cplusplus
#include <cstdint>
#define LAYOUT_BEGIN              \
    namespace strandlab::layout { \
    using address = uint64_t;     \
    using uint = uint32_t;
#define LAYOUT_SIZE(type, bytes) static_assert(sizeof(type) == (bytes));
#define LAYOUT_END }
#else
#define address uvec2
#define LAYOUT_BEGIN
#define LAYOUT_SIZE(type, bytes)
#define LAYOUT_END
#endif

#endif
