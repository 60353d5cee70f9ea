// Layout header: the push constants of a trace and the table of geometries, in GLSL and C++.
#ifndef STRANDLAB_TRACE_PARAMETERS_H
#define STRANDLAB_TRACE_PARAMETERS_H

#include "layout.h"

LAYOUT_BEGIN

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
    address scene;     // acceleration structure of the instances
    address rays;      // Ray[]
    address hits;      // Hit[]
    address normals;   // 3 floats per ray; read only when normals are asked for
    address rows;      // GeometryRow[], indexed by the custom index of the structure's instance
    uint first_ray;    // of this launch
    uint ray_count;    // rays beyond it are not traced
    uint ray_flags;    // gl_RayFlags* besides opaque
    uint is_shadow;    // not 0: only whether anything is hit
    GeometryRow row;   // the only one, where there is but one
    address counters;  // 4 uints per ray; used only by shaders that count their work
    uint width;        // of the launch, for ray queries: other shaders know it
    uint is_tiled;     // a picture: neighbours lie in both directions
};

LAYOUT_SIZE(TraceParameters, 120)
LAYOUT_SIZE(GeometryRow, 48)
LAYOUT_END

#endif
