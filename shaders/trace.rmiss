#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/trace.glsl"

layout(location = 0) rayPayloadInEXT TracePayload payload;

void main() { payload.hit = miss(); }
