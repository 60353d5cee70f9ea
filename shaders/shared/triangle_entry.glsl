// The entry of a primitive of triangles, after its
//
//     Hit finish_hit(GeometryRow row, Leaf leaf, vec2 barycentrics, vec3 direction, float tmin, float t,
//                    out vec3 normal)
//
// (what is written for the nearest hit; direction and normal in object space): as a closest-hit shader, or,
// with RAY_QUERY, as the whole of a compute shader.
#ifdef RAY_QUERY
#include "shared/query.glsl"

// Only where triangles of other rays' curves are to be turned away.
void meet_candidate() {
    GeometryRow row = fetch_row(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
    if (!is_foreign(row, fetch_leaf(row, rayQueryGetIntersectionPrimitiveIndexEXT(query, false))))
        rayQueryConfirmIntersectionEXT(query);
}

Hit committed_hit(GeometryRow row, Leaf leaf, float t, out vec3 object_normal) {
    return finish_hit(row, leaf, rayQueryGetIntersectionBarycentricsEXT(query, true),
                      rayQueryGetIntersectionObjectRayDirectionEXT(query, true), query_tmin, t, object_normal);
}
#else
layout(location = 0) rayPayloadInEXT TracePayload payload;
hitAttributeEXT vec2 triangle_barycentrics;

void main() {
    GeometryRow row = fetch_row(gl_InstanceCustomIndexEXT);
    Leaf leaf = fetch_leaf(row, gl_PrimitiveID);
    vec3 normal = vec3(0.0);
    payload.hit = finish_hit(row, leaf, triangle_barycentrics, gl_ObjectRayDirectionEXT, gl_RayTminEXT, gl_HitTEXT,
                             normal);
    if (wants_normals) payload.normal = normalize(vec3(normal * gl_WorldToObjectEXT));
}
#endif
