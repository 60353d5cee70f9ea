#version 460
#extension GL_GOOGLE_include_directive : require
// The payload holds a miss until something is hit.
#include "shared/trace.glsl"

layout(location = 0) rayPayloadInEXT TracePayload payload;

void main() {}
