// Code header: roving capsules as published (Reshetov & Hart 2024 and their public code): capsules of a
// heuristic length, whose own entries are the hits. Kept as it is known, with its limits: chords lie
// inside bends, the length is not scale invariant, and rays that start inside see the capsules' caps.

// Entry into the capsule between two curve points: depth and parameter, both roots computed from the plain
// discriminant; one of them mirrored where it lies on the other nappe.
FUNCTION bool published_capsule_entry(real4 p, real4 q, bool open_start, bool open_end, OUT(real) z,
                                      OUT(real) u) {
    real4 axis = q - p;
    real a = axis.w * axis.w - axis.x * axis.x - axis.y * axis.y;
    real e = axis.z * axis.z - a;
    real f = axis.x * p.x + axis.y * p.y - p.w * axis.w;
    real g = p.x * p.x + p.y * p.y - p.w * p.w;
    real discriminant = f * f + g * a;
    if (!(discriminant >= real(0))) return false;
    real w = axis.z * sqrt(discriminant / e);
    real u0 = (f + w) / a;
    real u1 = (f - w) / a;
    if (u0 * axis.w < -p.w) u0 = real(1) - u0;
    if (u1 * axis.w < -p.w) u1 = real(1) - u1;
    u = (axis.z >= real(0)) != (u1 > u0) ? u1 : u0;
    if ((open_start && !(u >= real(0))) || (open_end && !(u <= real(1)))) return false;
    u = min(max(u, real(0)), real(1));
    real4 centre = p + axis * u;
    real inside = centre.w * centre.w - centre.x * centre.x - centre.y * centre.y;
    if (!(inside >= real(0))) return false;
    z = centre.z - sqrt(inside);
    return true;
}

FUNCTION real l1_norm(real4 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// Length of the capsules in u, from L1 norms of speed, acceleration and jerk.
FUNCTION real published_step(FrameCubic c) {
    real4 c1 = (c.p1 - c.p0) * real(6);
    real4 c2 = (c.p2 - c.p1) * real(3);
    real4 c3 = (c.p3 - c.p2) * real(6);
    real speed = l1_norm(c1);
    real acceleration = l1_norm(c2 * real(2) - c1);
    real jerk = l1_norm(c1 - c2 * real(4) + c3) / real(3);
    real widening = abs(real(2) * c2.w - c1.w);
    real radius = (c.p0.w + c.p1.w + c.p2.w + c.p3.w) * real(0.25);
    real step = speed / (acceleration + jerk);
    step = step * min(real(1), real(0.5) / widening);
    step = real(0.02) * (real(1) + step);
    step = step * min(max(real(1) / speed, real(0.05)), real(3));
    step = min(step, real(20) * radius / speed);
    // Also where a curve without speed makes it 0 / 0.
    if (!(step >= real(0.002))) step = real(0.002);
    return min(step, real(0.25));
}

// Whether all balls of [a, b] stay on one side of the plane y = 0 of the frame, which holds the ray and faces
// the middle of the curve along x.
FUNCTION bool published_plane_separates(FrameCubic c, real a, real b) {
    real4 first;
    real4 last;
    real4 second;
    real4 start = cubic_jet(c, a, first, second);
    real4 end = cubic_jet(c, b, last, second);
    if (!(start.x - start.w >= real(0)) || !(end.x - end.w >= real(0))) return false;
    // The local minimum of x - r: the root of its derivative d0 + 2 d1 u + d2 u^2 where it rises.
    real4 e0 = c.p1 - c.p0;
    real4 e1 = c.p2 - c.p1;
    real4 e2 = c.p3 - c.p2;
    real d0 = e0.x - e0.w;
    real d1 = (e1.x - e1.w) - d0;
    real d2 = (e2.x - e2.w) - (e1.x - e1.w) - d1;
    real discriminant = d1 * d1 - d0 * d2;
    if (!(discriminant > real(0))) return true;
    real root = sqrt(discriminant);
    real u = d1 > real(0) ? -d0 / (d1 + root) : (root - d1) / d2;
    if (!(u > a && u < b)) return true;
    real4 lowest = cubic_point(c, u);
    return lowest.x - lowest.w >= real(0);
}

// Up to three secant steps of u towards the foot of the surface point (0, 0, z) on the curve.
FUNCTION real published_foot(FrameCubic c, real z, real u, real first_step) {
    real previous_u = u;
    real previous = real(0);
    ROLLED for (int i = 0; i < 4; ++i) {
        real4 d;
        real4 dd;
        real4 p = cubic_jet(c, u, d, dd);
        real value = -p.x * d.x - p.y * d.y + (z - p.z) * d.z + p.w * d.w;
        real next = u + first_step;
        if (i > 0) next = u - value * (u - previous_u) / (value - previous);
        if (i == 3 || !(next >= real(0) && next <= real(1))) break;
        previous = value;
        previous_u = u;
        u = next;
    }
    return u;
}

// Piece `piece` of `pieces` of a curve against a ray: entering hits with tmin <= t < tmax.
SELDOM bool rocaps_published(real3 origin, real3 direction, real tmin, real tmax, real4 c0, real4 c1,
                             real4 c2, real4 c3, uint piece, uint pieces, bool begins_strand,
                             bool ends_strand, bool open_ends, OUT(real) t, OUT(real) u, OUT(real3) normal) {
    // The frame: x across the plane of the ray and the curve's middle tangent, z along the ray.
    real size = sqrt(dot(direction, direction));
    real3 n = direction / size;
    real3 tangent = real3(c3) + real3(c2) - real3(c1) - real3(c0);
    real3 x_axis = cross(n, tangent);
    real across = sqrt(dot(x_axis, x_axis));
    if (!(across >= real(1e-3) * sqrt(dot(tangent, tangent)) && across > real(0))) {
        x_axis = abs(n.x) < real(0.5) ? cross(n, real3(real(1), real(0), real(0)))
                                      : cross(n, real3(real(0), real(1), real(0)));
        across = sqrt(dot(x_axis, x_axis));
    }
    x_axis = x_axis / across;
    real3 middle =
        (real3(c0) - origin) + (real3(c3) - origin) + ((real3(c1) - origin) + (real3(c2) - origin)) * real(3);
    if (dot(middle, x_axis) < real(0)) x_axis = -x_axis;
    real3 y_axis = cross(n, x_axis);
    real3 v0 = real3(c0) - origin;
    real3 v1 = real3(c1) - origin;
    real3 v2 = real3(c2) - origin;
    real3 v3 = real3(c3) - origin;
    FrameCubic c;
    c.p0 = real4(dot(v0, x_axis), dot(v0, y_axis), dot(v0, n), c0.w);
    c.p1 = real4(dot(v1, x_axis), dot(v1, y_axis), dot(v1, n), c1.w);
    c.p2 = real4(dot(v2, x_axis), dot(v2, y_axis), dot(v2, n), c2.w);
    c.p3 = real4(dot(v3, x_axis), dot(v3, y_axis), dot(v3, n), c3.w);

    real a = real(piece) / real(pieces);
    real b = real(piece + 1u) / real(pieces);
    if (published_plane_separates(c, a, b)) return false;
    real step = min(published_step(c), b - a);
    real z_min = tmin * size;
    real z = tmax * size;
    bool found = false;
    real start = a;
    // A capsule is at least 0.002 long.
    ROLLED for (int i = 0; i < 512; ++i) {
        real4 p = cubic_point(c, start);
        real distance = axis_distance(p);
        if (distance > p.w) {
            real next = next_possible_u(c, p, distance, real(0), start, b);
            if (!(next < b)) break;
            start = min(next, b - step);
            p = cubic_point(c, start);
        }
        COUNT_ITERATION
        real end = min(b, start + step);
        real4 q = cubic_point(c, end);
        bool open_start = open_ends && begins_strand && start <= real(0);
        bool open_end = open_ends && ends_strand && end >= real(1);
        real capsule_z;
        real capsule_u;
        if (published_capsule_entry(p, q, open_start, open_end, capsule_z, capsule_u) && capsule_z >= z_min &&
            capsule_z < z) {
            z = capsule_z;
            u = lerp(start, end, capsule_u);
            found = true;
        }
        start = end;
        if (!(start < b)) break;
    }
    if (!found) return false;
    u = published_foot(c, z, u, real(0.1) * step);
    real4 centre = cubic_point(c, u);
    real3 out_of = real3(-centre.x, -centre.y, z - centre.z);
    out_of = normal_or_facing(out_of / sqrt(dot(out_of, out_of)));
    normal = x_axis * out_of.x + y_axis * out_of.y + n * out_of.z;
    t = z / size;
    return t >= tmin && t < tmax;
}
