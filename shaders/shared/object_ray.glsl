// The ray in the space of the curves, for intersection shaders.
#ifndef STRANDLAB_OBJECT_RAY_GLSL
#define STRANDLAB_OBJECT_RAY_GLSL

// An instance that is not moved has no matrix to fetch.
vec3 object_origin() { return is_in_place ? gl_WorldRayOriginEXT : gl_ObjectRayOriginEXT; }
vec3 object_direction() { return is_in_place ? gl_WorldRayDirectionEXT : gl_ObjectRayDirectionEXT; }

#endif
