// Layout header: what the shader that makes boxes for curves on the device reads, in GLSL and C++.
#ifndef STRANDLAB_BOX_PARAMETERS_H
#define STRANDLAB_BOX_PARAMETERS_H

#include "../shared/layout.h"

LAYOUT_BEGIN

struct BoxParameters {
    address curves;   // 16 floats each; the ends of strands are marked in place
    address boxes;    // 6 floats each, splits a curve: written
    address turning;  // one uint: leaves that turn by more than a right angle are added
    uint curve_count;
    uint splits;  // leaves of a curve
    uint curves_per_strand;
    uint marks_ends;  // not 0: the radius of a strand's first and last control point becomes negative
    float extent;     // largest coordinate of any ray origin
    uint unused;
};

LAYOUT_SIZE(BoxParameters, 48)
LAYOUT_END

#endif
