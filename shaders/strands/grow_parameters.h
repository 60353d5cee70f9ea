// Layout header: what the shaders that grow strands read, in GLSL and C++.
#ifndef STRANDLAB_GROW_PARAMETERS_H
#define STRANDLAB_GROW_PARAMETERS_H

#include "../shared/layout.h"

LAYOUT_BEGIN

// A face and its strands.
struct GrowthFace {
    uint corners[4];  // vertices; a triangle's fourth is its first
    uint is_triangle;
    uint first_strand;
    float root_radius;
    float tip_radius;
};

struct GrowthTables {
    address faces;     // GrowthFace[]
    address controls;  // 3 floats each: 3 layers + 1 of every column
    address u;         // 3 floats each: layers + 1 of every column, as v; w: one float each
    address v;
    address w;
    address uv;       // 2 floats of every vertex
    address samples;  // 2 floats each: sample_count of the square, as many of the triangle
    address shifts;   // 4 floats a round of the samples: of the square, of the triangle
    address style;    // StrandStyle
    uint face_count;
    uint sample_count;
    uint layers;
    uint clumps;  // 0: the clump does not matter
    uint seed;
    uint pieces;  // curves of a strand
    uint is_styled;
    float point_step;  // 1 / pieces; unstyled 1 / (3 layers)
    float morph;       // 0: none
    uint unused;
};

struct GrowthParameters {
    address tables;  // GrowthTables
    address points;  // 4 floats each: pieces + 1 of every strand from first_strand on
    address curves;  // 16 floats each: pieces of every strand from first_strand on
    uint first_strand;
    uint strand_count;
};

LAYOUT_SIZE(GrowthFace, 32)
LAYOUT_SIZE(GrowthTables, 112)
LAYOUT_SIZE(GrowthParameters, 32)
LAYOUT_END

#endif
