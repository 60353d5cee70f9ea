// Tracing by ray queries in a compute shader: what trace.rgen and the stages behind it do. The file that
// includes this says what happens to candidates and what is written for the nearest hit.
#include "shared/object_ray.glsl"

layout(local_size_x = 64) in;

rayQueryEXT query;

void meet_candidate();
Hit committed_hit(GeometryRow row, Leaf leaf, float t, out vec3 object_normal);

void write_normal(vec3 normal) {
    FloatBuffer normals = FloatBuffer(parameters.normals);
    normals.items[3u * query_ray] = normal.x;
    normals.items[3u * query_ray + 1u] = normal.y;
    normals.items[3u * query_ray + 2u] = normal.z;
}

// Of 64 lanes along a Z-order curve.
uvec2 place_in_tile(uint lane) {
    return uvec2((lane & 1u) | ((lane >> 1) & 2u) | ((lane >> 2) & 4u),
                 ((lane >> 1) & 1u) | ((lane >> 2) & 2u) | ((lane >> 3) & 4u));
}

void main() {
    // Work groups are squares of a picture, lanes next to each other neighbours in it; or stretches of a list.
    uint lane = gl_LocalInvocationIndex;
    uvec2 place = gl_WorkGroupID.xy * uvec2(64u, 1u) + uvec2(lane, 0u);
    if (parameters.is_tiled != 0u) place = gl_WorkGroupID.xy * 8u + place_in_tile(lane);
    query_ray = parameters.first_ray + place.y * parameters.width + place.x;
    if (place.x >= parameters.width || query_ray >= parameters.ray_count) return;
    Ray ray = RayBuffer(parameters.rays).items[query_ray];
    query_origin = ray.origin;
    query_direction = ray.direction;
    query_tmin = ray.tmin;
    query_tmax = ray.tmax;
    uint flags = curves_of_a_ray != 0u ? 0u : gl_RayFlagsOpaqueEXT;
    rayQueryInitializeEXT(query, accelerationStructureEXT(parameters.scene), flags | parameters.ray_flags, 0xFFu,
                          ray.origin, ray.tmin, ray.direction, ray.tmax);
    while (rayQueryProceedEXT(query)) meet_candidate();

    Hit hit = miss();
    vec3 normal = vec3(0.0);
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT) {
        if (parameters.is_shadow != 0u) {
            hit = Hit(ray.tmin, 0.0, 0u, 0u);
        } else {
            GeometryRow row = fetch_row(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
            Leaf leaf = fetch_leaf(row, rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
            vec3 object_normal = vec3(0.0);
            hit = committed_hit(row, leaf, rayQueryGetIntersectionTEXT(query, true), object_normal);
            if (wants_normals)
                normal = normalize(vec3(object_normal * rayQueryGetIntersectionWorldToObjectEXT(query, true)));
        }
    }
    HitBuffer(parameters.hits).items[query_ray] = hit;
    if (wants_normals) write_normal(normal);
}
