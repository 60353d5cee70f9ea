// Code header: disjoint orthogonal triangle strips. Each straight piece of a strand has two crossed quads;
// a quad spans -axis .. +axis times the half width at both of its joints and is cut into two triangles,
// (start -, end -, start +) and (end +, start +, end -). Traversal meets the triangles; this text says
// where on the strand a triangle was met and what a round strand would look like there.

// A joint of the strips: a point of the centre line and the two unit axes across it.
struct DotsJoint {
    real3 centre;
    real radius;
    real3 axis_0;
    real3 axis_1;
};

// A joint from its record: (centre, radius) and the unit quaternion that turns x and y into the axes.
FUNCTION DotsJoint dots_joint(real4 place, real4 q) {
    DotsJoint joint;
    joint.centre = real3(place);
    joint.radius = place.w;
    joint.axis_0 = real3(real(1) - real(2) * (q.y * q.y + q.z * q.z), real(2) * (q.x * q.y + q.w * q.z),
                         real(2) * (q.x * q.z - q.w * q.y));
    joint.axis_1 = real3(real(2) * (q.x * q.y - q.w * q.z), real(1) - real(2) * (q.x * q.x + q.z * q.z),
                         real(2) * (q.y * q.z + q.w * q.x));
    return joint;
}

// Fraction of the way from the start joint to the end joint: what the barycentrics of the second and the
// third vertex say. Two-fold symmetry makes the second triangle the first one seen from the other corner.
FUNCTION real dots_along(real2 barycentrics, uint triangle) {
    return triangle == 0u ? barycentrics.x : real(1) - barycentrics.x;
}

// The hit relative to the centre line, interpolated as the triangle interpolates it.
FUNCTION real3 dots_offset(DotsJoint start, DotsJoint end, uint quad, uint triangle, real2 barycentrics,
                           real width_factor) {
    real first = real(1) - barycentrics.x - barycentrics.y;
    // Share of the + corner less the share of the - corner, at both joints.
    real at_start = triangle == 0u ? barycentrics.y - first : barycentrics.x;
    real at_end = triangle == 0u ? -barycentrics.x : first - barycentrics.y;
    real3 start_axis = quad == 0u ? start.axis_0 : start.axis_1;
    real3 end_axis = quad == 0u ? end.axis_0 : end.axis_1;
    return start_axis * (at_start * start.radius * width_factor) +
           end_axis * (at_end * end.radius * width_factor);
}

// Unit normal of the triangle on the side that the ray comes from; against the ray where there is none.
FUNCTION real3 dots_flat_normal(real3 direction, DotsJoint start, DotsJoint end, uint quad, uint triangle,
                                real width_factor) {
    real3 start_edge = (quad == 0u ? start.axis_0 : start.axis_1) * (start.radius * width_factor);
    real3 end_edge = (quad == 0u ? end.axis_0 : end.axis_1) * (end.radius * width_factor);
    // Edges, not vertices: relative to each other they keep all digits.
    real3 chord = end.centre - start.centre;
    real3 along = triangle == 0u ? (chord - end_edge) + start_edge : (chord + end_edge) - start_edge;
    real3 across = triangle == 0u ? start_edge : end_edge;
    real3 normal = cross(along, across);
    real size = length(normal);
    if (!(size > real(0))) return direction / -length(direction);
    return normal / (dot(normal, direction) > real(0) ? -size : size);
}

// What the ray would have met on a round strand of the hit's radius around the chord: the position
// across the strand as the ray sees it gives the normal, and the depth of that point the step (in units
// of the ray parameter) from the strip to it. A ray along the strand has no side: its normal faces it.
FUNCTION real3 dots_round_normal(real3 direction, real3 tangent, real3 offset, real radius, OUT(real) step) {
    step = real(0);
    real3 side = cross(tangent, direction);
    real speed_across = length(side);
    real speed = length(direction);
    if (!(speed_across > real(1e-6) * speed)) return direction / -speed;
    side = side / speed_across;
    real3 facing = cross(side, tangent);
    // Beyond the silhouette (strips may be wider than the strand) the silhouette itself is the nearest.
    real x = clamp(dot(offset, side), -radius, radius);
    real depth = sqrt((radius - x) * (radius + x));
    step = (-depth - dot(offset, facing)) / speed_across;
    if (!(radius > real(0))) return -facing;
    return (side * x - facing * depth) / radius;
}

// Moves a hit along the ray by step, but not beyond the ends of its piece and not before tmin.
FUNCTION void dots_move(real3 direction, real3 tangent, real chord_length, real3 offset, real step, real tmin,
                        INOUT(real) t, INOUT(real) along) {
    real speed_along = dot(direction, tangent);
    real from = clamp(along * chord_length + dot(offset, tangent), real(0), chord_length);
    real wanted = speed_along * step;
    real moved = clamp(from + wanted, real(0), chord_length) - from;
    real part = abs(wanted) > abs(moved) ? moved / wanted : real(1);
    real arrival = max(t + step * part, tmin);
    real travelled = speed_along * (arrival - t);
    real reached = clamp((from + travelled) / chord_length, real(0), real(1));
    if (!(abs(arrival) <= real(3e38) && reached >= real(0))) return;  // no numbers: stay on the strip
    t = arrival;
    along = reached;
}

// Normal of a hit (round, or of the triangle), and with round_offset its place on the round strand.
// t and along are those of the triangle before.
FUNCTION void dots_finish(real3 direction, real tmin, DotsJoint start, DotsJoint end, uint quad,
                          uint triangle, real2 barycentrics, real width_factor, bool round_normals,
                          bool round_offset, INOUT(real) t, INOUT(real) along, OUT(real3) normal) {
    real3 offset = dots_offset(start, end, quad, triangle, barycentrics, width_factor);
    real radius = start.radius + (end.radius - start.radius) * along;
    real3 chord = end.centre - start.centre;
    real chord_length = length(chord);
    real3 tangent = chord_length > real(0) ? chord / chord_length : cross(start.axis_0, start.axis_1);
    real step;
    real3 round_normal = dots_round_normal(direction, tangent, offset, radius, step);
    normal =
        round_normals ? round_normal : dots_flat_normal(direction, start, end, quad, triangle, width_factor);
    if (round_offset && chord_length > real(0))
        dots_move(direction, tangent, chord_length, offset, step, tmin, t, along);
}
