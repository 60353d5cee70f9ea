// The ray in the space of the curves, for intersectors.
#ifndef STRANDLAB_OBJECT_RAY_GLSL
#define STRANDLAB_OBJECT_RAY_GLSL

#ifdef RAY_QUERY
vec3 query_origin;
vec3 query_direction;
float query_tmin;
float query_tmax;
vec3 object_origin() { return query_origin; }
vec3 object_direction() { return query_direction; }
float ray_tmin() { return query_tmin; }
float ray_tmax() { return query_tmax; }
#else
// An instance that is not moved has no matrix to fetch.
vec3 object_origin() { return is_in_place ? gl_WorldRayOriginEXT : gl_ObjectRayOriginEXT; }
vec3 object_direction() { return is_in_place ? gl_WorldRayDirectionEXT : gl_ObjectRayDirectionEXT; }
float ray_tmin() { return gl_RayTminEXT; }
float ray_tmax() { return gl_RayTmaxEXT; }
#endif

#endif
