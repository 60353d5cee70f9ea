// Code header: a triangle against the z axis of the ray frame (edge functions, as Woop, Benthin and Wald
// 2013). Both signs count, so that triangles are two-sided; edges belong to both neighbours, and the edge
// functions of two triangles in one frame are each other's exact negatives, so that no ray slips between.

// Depth of the hit and the barycentrics of b and c.
FUNCTION bool triangle_entry(real3 a, real3 b, real3 c, OUT(real) z, OUT(real2) barycentrics) {
    real weight_a = b.x * c.y - b.y * c.x;
    real weight_b = c.x * a.y - c.y * a.x;
    real weight_c = a.x * b.y - a.y * b.x;
    bool all_front = weight_a >= real(0) && weight_b >= real(0) && weight_c >= real(0);
    bool all_back = weight_a <= real(0) && weight_b <= real(0) && weight_c <= real(0);
    real area = weight_a + weight_b + weight_c;
    if (!((all_front || all_back) && abs(area) > real(0))) return false;
    barycentrics = real2(weight_b / area, weight_c / area);
    z = (weight_a * a.z + weight_b * b.z + weight_c * c.z) / area;
    // Seen edge-on, from beside it too, the areas are nothing but rounding: then they do not lead back to the
    // ray.
    real x = (weight_a * a.x + weight_b * b.x + weight_c * c.x) / area;
    real y = (weight_a * a.y + weight_b * b.y + weight_c * c.y) / area;
    real reach_x = max(abs(a.x), max(abs(b.x), abs(c.x)));
    real reach_y = max(abs(a.y), max(abs(b.y), abs(c.y)));
    return max(abs(x), abs(y)) <= real(0.05) * max(reach_x, reach_y);
}
