// Layout header: the push constants of a trace and the table of geometries, in GLSL and C++.
// Addresses are uvec2 in GLSL, so that no 64-bit integer feature is needed.
#ifndef STRANDLAB_TRACE_PARAMETERS_H
#define STRANDLAB_TRACE_PARAMETERS_H

#ifdef __cplusplus
#include <cstdint>
namespace strandlab::layout {
using address = uint64_t;
using uint = uint32_t;
#else
#define address uvec2
#endif

// One instance of a bottom-level acceleration structure: where its shaders find their records.
struct GeometryRow {
    address leaves;           // Leaf[], or unused where the leaf follows from its index
    address leaf_records;     // one per leaf
    address curve_records;    // one per curve
    address shading_records;  // whatever the closest-hit shader wants for normals
    uint first_leaf;          // of this structure within its geometry
    uint first_curve;         // of this model within the scene
    uint pieces;              // per curve, where the leaf follows from its index
    uint instance;            // of the scene: hits name it
};

struct TraceParameters {
    address scene;    // acceleration structure of the instances
    address rays;     // Ray[]
    address hits;     // Hit[]
    address normals;  // 3 floats per ray; read only when normals are asked for
    address rows;     // GeometryRow[], indexed by the custom index of the structure's instance
    uint first_ray;   // of this launch
    uint ray_count;   // rays beyond it are not traced
    uint ray_flags;   // gl_RayFlags* besides opaque
    uint is_shadow;   // not 0: only whether anything is hit
    GeometryRow row;  // the only one, where there is but one
    address counters; // 4 uints per ray; used only by shaders that count their work
    uint width;       // of the launch, for ray queries: other shaders know it
    uint is_tiled;    // a picture: neighbours lie in both directions
};

#ifdef __cplusplus
static_assert(sizeof(TraceParameters) == 120 && sizeof(GeometryRow) == 48);
}  // namespace strandlab::layout
#else
#undef address
#endif

#endif
