// The attribute block of every intersection shader: what the primitive itself decided.
#ifndef STRANDLAB_CURVE_ATTRIBUTES_GLSL
#define STRANDLAB_CURVE_ATTRIBUTES_GLSL

// x: u on the curve; yzw: unit normal in object space.
hitAttributeEXT vec4 curve_attributes;

#endif
