// Code header: linear swept sphere (round cone), closed form (intersectors.md section 4).
// The ray is the z axis; the cone runs from (q, z0) with radius ra to q + axis with radius rb.

struct RoundConeHit {
    real z;  // depth of the entry
    real u;  // 0 at the start, 1 at the end
    real radius;
    real3 normal;  // unit, in the frame of the ray
};

// The entry into the ball at parameter u; false when the ray passes it.
FUNCTION bool ball_entry(real3 start, real3 axis, real ra, real dr, real u, OUT(RoundConeHit) hit) {
    real3 centre = start + axis * u;
    real r = ra + dr * u;
    real distance = sqrt(centre.x * centre.x + centre.y * centre.y);
    real inside = (r - distance) * (r + distance);
    if (!(inside >= real(0) && r > real(0))) return false;
    real depth = sqrt(inside);
    hit.z = centre.z - depth;
    hit.u = u;
    hit.radius = r;
    hit.normal = real3(-centre.x, -centre.y, -depth) / r;
    return true;
}

// The nearest of two ball entries where an end of the cone is the answer.
FUNCTION bool end_entry(real3 start, real3 axis, real ra, real dr, bool open_start, bool open_end,
                        OUT(RoundConeHit) hit) {
    RoundConeHit first;
    RoundConeHit second;
    bool has_first = !open_start && ball_entry(start, axis, ra, dr, real(0), first);
    bool has_second = !open_end && ball_entry(start, axis, ra, dr, real(1), second);
    if (has_first && !(has_second && second.z < first.z))
        hit = first;
    else if (has_second)
        hit = second;
    return has_first || has_second;
}

// First entry of the ray line into the round cone; open ends have no cap.
FUNCTION bool round_cone_entry(real3 start, real ra, real3 end, real rb, bool open_start, bool open_end,
                               OUT(RoundConeHit) hit) {
    real3 axis = end - start;
    real dr = rb - ra;
    real slant = dr * dr;
    real lateral = axis.x * axis.x + axis.y * axis.y;
    real a = slant - lateral;
    real e = lateral + axis.z * axis.z - slant;
    // One ball holds the other: there is no cone, and its cap is the whole surface.
    if (!(e > real(0))) {
        bool larger_is_end = dr > real(0);
        bool open = larger_is_end ? open_end : open_start;
        return !open && ball_entry(start, axis, ra, dr, larger_is_end ? real(1) : real(0), hit);
    }
    real f = start.x * axis.x + start.y * axis.y - ra * dr;
    // Lagrange's identity: the naive f^2 + g a cancels.
    real along_x = ra * axis.x - dr * start.x;
    real along_y = ra * axis.y - dr * start.y;
    real turn = axis.x * start.y - axis.y * start.x;
    real along = sqrt(along_x * along_x + along_y * along_y);
    real discriminant = (along - abs(turn)) * (along + abs(turn));
    bool found = false;
    // A ray within the cone's opening angle: the depth can be concave in u, so both ends count too.
    if (a > real(0)) {
        found = end_entry(start, axis, ra, dr, open_start, open_end, hit);
        if (!(discriminant > real(0))) return found;
    }
    if (!(discriminant >= real(0))) return false;
    real depth = sqrt(discriminant / e);  // of the entry before the centre of the ball that it lies on
    real w = axis.z * depth;
    real u = (f + w) / a;
    if (abs(a) < real(1e-6) * (lateral + slant)) {
        real g = start.x * start.x + start.y * start.y - ra * ra;
        u = -(f * f + axis.z * axis.z * g) / (e * (f - w));
    }
    bool is_side = abs(u) <= real(1e18);
    if (!is_side) u = axis.z >= real(0) ? real(0) : real(1);  // parallel to a cylinder
    if (ra + u * dr < real(0)) {                              // the other nappe
        u = dr > real(0) ? real(1) : real(0);
        is_side = false;
    }
    // The two cases above choose an end itself: it is open too.
    if ((u <= real(0) && open_start) || (u >= real(1) && open_end)) return found;
    real within = clamp(u, real(0), real(1));
    RoundConeHit side;
    // Up to a rounding error beyond an end the side counts: neither piece of a joint may leave the ray to the
    // other. There the depth is known; as the leg of a triangle with the radius, it is lost to rounding where
    // the normal is nearly across the ray, as on all of a piece that the ray almost follows.
    if (is_side && abs(u - within) <= real(16) * real_epsilon) {
        side.radius = ra + within * dr;
        side.z = start.z + axis.z * within - depth;
        side.u = within;
        side.normal = real3(-(start.x + axis.x * within), -(start.y + axis.y * within), -depth) / side.radius;
        is_side = side.radius > real(0);
    } else {
        is_side = ball_entry(start, axis, ra, dr, within, side);
    }
    if (is_side) {
        if (!found || side.z < hit.z) hit = side;
        found = true;
    }
    return found;
}

// One piece of a curve against a ray: entering hits with tmin <= t < tmax. u counts along the whole curve.
FUNCTION bool lss_intersect(real3 origin, real3 direction, real tmin, real tmax, real4 start, real4 end,
                            uint piece, uint pieces, bool open_start, bool open_end, bool early_out,
                            OUT(real) t, OUT(real) u, OUT(real3) normal) {
    real3 first = real3(start);
    real3 last = real3(end);
    if (early_out && passes_straight(origin, direction, start, end)) return false;
    RayFrame frame = make_ray_frame(origin, direction, first, (last - first) * real(0.5));
    real3 from = to_frame(frame, first);
    real3 to = to_frame(frame, last);
    real3 largest = max(abs(from), abs(to));
    real unit = safe_unit(max(max(largest.x, largest.y), max(largest.z, max(start.w, end.w))));
    RoundConeHit hit;
    if (!round_cone_entry(from * unit, start.w * unit, to * unit, end.w * unit, open_start, open_end, hit))
        return false;
    t = ray_parameter(frame, hit.z / unit);
    u = (real(piece) + hit.u) / real(pieces);
    normal = from_frame(frame, normal_or_facing(hit.normal));
    return t >= tmin && t < tmax;
}
