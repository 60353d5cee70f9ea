// The entry of a primitive with an intersector, after its
//
//     bool intersect_leaf(GeometryRow row, Leaf leaf, uint record, out float t, out float u, out vec3 normal)
//
// (whether the object-space ray meets the leaf; record counts through the leaves of the geometry): as an
// intersection shader, or, with RAY_QUERY, as the whole of a compute shader.
#ifdef RAY_QUERY
#include "shared/query.glsl"

vec4 best_attributes = vec4(0.0);  // as curve_attributes

void meet_candidate() {
    GeometryRow row = fetch_row(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
    uint primitive = rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
    Leaf leaf = fetch_leaf(row, primitive);
    if (is_foreign(row, leaf)) return;
    if (!is_in_place) {
        query_origin = rayQueryGetIntersectionObjectRayOriginEXT(query, false);
        query_direction = rayQueryGetIntersectionObjectRayDirectionEXT(query, false);
    }
    float t;
    float u;
    vec3 normal;
    bool is_hit = intersect_leaf(row, leaf, row.first_leaf + primitive, t, u, normal);
    count_leaf(is_hit);
    if (!is_hit) return;
    best_attributes = vec4(u, wants_normals ? normal : vec3(0.0));
    query_tmax = t;
    rayQueryGenerateIntersectionEXT(query, t);
}

Hit committed_hit(GeometryRow row, Leaf leaf, float t, out vec3 object_normal) {
    object_normal = best_attributes.yzw;
    return Hit(t, best_attributes.x, row.first_curve + leaf.curve, row.instance);
}
#else
#include "shared/curve_attributes.glsl"

void main() {
    GeometryRow row = fetch_row(gl_InstanceCustomIndexEXT);
    Leaf leaf = fetch_leaf(row, gl_PrimitiveID);
    if (is_foreign(row, leaf)) return;
    float t;
    float u;
    vec3 normal;
    bool is_hit = intersect_leaf(row, leaf, row.first_leaf + gl_PrimitiveID, t, u, normal);
    count_leaf(is_hit);
    if (!is_hit) return;
    // Written just before the report and never after: otherwise attributes of rejected candidates win.
    curve_attributes = vec4(u, wants_normals ? normal : vec3(0.0));
    reportIntersectionEXT(t, 0u);
}
#endif
