#version 460
#extension GL_GOOGLE_include_directive : require
// Closest hit of all primitives with an intersection shader.
#include "shared/trace.glsl"
#include "shared/curve_attributes.glsl"

layout(location = 0) rayPayloadInEXT TracePayload payload;

void main() {
    GeometryRow row = fetch_row(gl_InstanceCustomIndexEXT);
    Leaf leaf = fetch_leaf(row, gl_PrimitiveID);
    payload.hit = Hit(gl_HitTEXT, curve_attributes.x, row.first_curve + leaf.curve, row.instance);
    if (wants_normals) payload.normal = normalize(vec3(curve_attributes.yzw * gl_WorldToObjectEXT));
}
