// Code header: the phantom ray-hair intersector (Reshetov & Luebke, "Phantom Ray-Hair Intersector", HPG
// 2018). The surface is swept by a disc of radius r(u) normal to the curve C(u). At a parameter v the tube
// is replaced by the infinite cone with that axis, base and slant; v moves by the distance, in parameters,
// from the cone's base plane to the ray's entry ("phantom" entry: the closest approach, where the ray
// misses the cone), until that distance vanishes.
//
// robust = false is the published algorithm. robust = true differs in: the exact frame, unit tangents and a
// discriminant without cancellation, the root's conjugate form for rays along the axis, steps clamped to the
// interval instead of leaving it, phantoms that have converged end the search, zero tangents and other 0/0
// are stepped over, one Newton step on the tube itself at the end.

// A cubic Bezier piece in the frame of the ray (the ray is the z axis); w is the radius.
struct PrhiCubic {
    real4 p0;
    real4 p1;
    real4 p2;
    real4 p3;
};

struct PrhiPoint {
    real4 c;       // C, r
    real4 d;       // C', r'
    real4 second;  // C'', r''
};

struct PrhiStep {
    real dv;      // from v to the base plane of the entry, in parameters
    real s;       // depth of the entry (or closest approach), counted from C(v)
    bool enters;  // on the outside of the cone, not a phantom
};

struct PrhiHit {
    real z;  // depth along the ray
    real v;
    real3 normal;  // in the frame of the ray
};

// Accepted distance to the base plane, in parameters of the piece.
FUNCTION real prhi_tolerance() { return real(5e-5); }

// The part [a, b] of a cubic (blossoming: neighbouring parts share their end points bit for bit).
FUNCTION PrhiCubic prhi_part(PrhiCubic c, real a, real b) {
    real4 a0 = mix(c.p0, c.p1, a);
    real4 a1 = mix(c.p1, c.p2, a);
    real4 a2 = mix(c.p2, c.p3, a);
    real4 b0 = mix(c.p0, c.p1, b);
    real4 b1 = mix(c.p1, c.p2, b);
    real4 b2 = mix(c.p2, c.p3, b);
    real4 aa0 = mix(a0, a1, a);
    real4 aa1 = mix(a1, a2, a);
    real4 ab0 = mix(a0, a1, b);
    real4 ab1 = mix(a1, a2, b);
    real4 bb0 = mix(b0, b1, b);
    real4 bb1 = mix(b1, b2, b);
    PrhiCubic part;
    part.p0 = mix(aa0, aa1, a);
    part.p1 = mix(aa0, aa1, b);
    part.p2 = mix(ab0, ab1, b);
    part.p3 = mix(bb0, bb1, b);
    return part;
}

// Each with the form that an H100's driver makes faster (source/primitives/README.md, speed).
FUNCTION real4 prhi_mix(real4 a, real4 b, real v, bool robust) {
    return robust ? mix(a, b, v) : native_mix(a, b, v);
}

// De Casteljau: the values near the ray keep their digits, unlike in powers of v.
FUNCTION PrhiPoint prhi_point(PrhiCubic c, real v, bool robust) {
    real4 a0 = prhi_mix(c.p0, c.p1, v, robust);
    real4 a1 = prhi_mix(c.p1, c.p2, v, robust);
    real4 a2 = prhi_mix(c.p2, c.p3, v, robust);
    real4 b0 = prhi_mix(a0, a1, v, robust);
    real4 b1 = prhi_mix(a1, a2, v, robust);
    PrhiPoint point;
    point.c = prhi_mix(b0, b1, v, robust);
    point.d = (b1 - b0) * real(3);
    point.second = ((a2 - a1) - (a1 - a0)) * real(6);
    return point;
}

// Whether the ray passes the hull of all discs on one side of the plane through ray and chord direction.
FUNCTION bool prhi_passes(PrhiCubic c) {
    real x = c.p3.x - c.p0.x;
    real y = c.p3.y - c.p0.y;
    real k0 = x * c.p0.y - y * c.p0.x;
    real k1 = x * c.p1.y - y * c.p1.x;
    real k2 = x * c.p2.y - y * c.p2.x;
    real low = min(k0, min(k1, k2));
    real high = max(k0, max(k1, k2));
    real nearest = max(low, -high);
    real reach = max(max(c.p0.w, c.p1.w), max(c.p2.w, c.p3.w));
    return nearest > real(0) && nearest * nearest > reach * reach * (x * x + y * y);
}

// The cone at a point, as the published codes intersect it.
FUNCTION PrhiStep prhi_published_step(real4 c, real4 d) {
    real lateral = d.x * d.x + d.y * d.y;
    real speed2 = lateral + d.z * d.z;
    real w = c.x * d.x + c.y * d.y;
    real k = c.x * d.y - c.y * d.x;
    real m = c.w * d.w;
    // lateral s^2 - 2 b s + a = 0; terms in r'^2 are left out, as in the paper.
    real b = d.z * (m - w);
    real a = real(2) * m * w + k * k - speed2 * c.w * c.w + (c.x * c.x + c.y * c.y) * d.z * d.z;
    real discriminant = b * b - a * lateral;
    PrhiStep result;
    result.enters = discriminant > real(0);
    result.s = (b - (result.enters ? sqrt(discriminant) : real(0))) / lateral;
    result.dv = (result.s * d.z - w) / speed2;
    return result;
}

// The same with a unit tangent (no powers of the curve's scale) and without cancellation. NaN where the
// tangent vanishes, or is parallel to a ray that misses.
FUNCTION PrhiStep prhi_robust_step(real4 c, real4 d) {
    real inv_speed = real(1) / sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    real4 t = d * inv_speed;
    real lateral = t.x * t.x + t.y * t.y;
    real w = c.x * t.x + c.y * t.y;
    real k = c.x * t.y - c.y * t.x;
    real m = c.w * t.w;
    real b = t.z * (m - w);
    real tilt = t.z * m;
    // b^2 - a lateral, multiplied out: the large terms cancel exactly.
    real discriminant = lateral * c.w * c.w - k * k - real(2) * m * w + tilt * tilt;
    PrhiStep result;
    result.enters = discriminant > real(0);
    real root = result.enters ? sqrt(discriminant) : real(0);
    if (result.enters && b > real(0)) {
        real a = real(2) * m * w + k * k - c.w * c.w + (c.x * c.x + c.y * c.y) * t.z * t.z;
        result.s = a / (b + root);
    } else {
        result.s = (b - root) / lateral;
    }
    real along = result.s * t.z - w;
    result.dv = along * inv_speed;
    // Counted from the base plane of the entry, its depth tells the outside from the inside.
    result.enters = result.enters && result.s - along * t.z <= tilt;
    return result;
}

// Outward normal of the swept discs at offset s from the point (unit): the derivative along the circle
// crossed with the one along the curve.
FUNCTION real3 prhi_normal(PrhiPoint p, real s, bool robust) {
    real3 tangent = real3(p.d);
    real inv_speed = real(1) / sqrt(dot(tangent, tangent));
    tangent = tangent * inv_speed;
    real3 e = real3(-p.c.x, -p.c.y, s);
    real slope = p.d.w * inv_speed;
    if (robust) {
        e = normalize(e - tangent * dot(e, tangent));
        // Where the discs overlap (r beyond the radius of curvature) the sheet turns over: stay outward.
        real shrink = real(1) - p.c.w * dot(e, real3(p.second)) * inv_speed * inv_speed;
        return normalize(e * max(shrink, real(0.05)) - tangent * slope);
    }
    return normalize(normalize(e) - tangent * slope);
}

// r^2 - x^2 - y^2, positive where the ray pierces the ball of that point.
FUNCTION real prhi_inside(real4 c) {
    real distance = sqrt(c.x * c.x + c.y * c.y);
    return (c.w - distance) * (c.w + distance);
}

// Whether a step's entry lies on its cone. Where a curve stands still while its radius changes the cone is so
// blunt that rounding takes all digits of the entry.
FUNCTION bool prhi_is_on_cone(PrhiPoint p, PrhiStep found) {
    real radius = p.c.w + abs(p.d.w * found.dv);
    real along_squared = found.dv * found.dv * dot(real3(p.d), real3(p.d));
    return p.c.x * p.c.x + p.c.y * p.c.y + found.s * found.s <=
           real(1.21) * (radius * radius + along_squared);
}

// The hit on the tube itself: the cone's own step, then one of Newton's on w - s z' = 0, where
// s^2 = r^2 - x^2 - y^2. False where there is none after all.
FUNCTION bool prhi_polish(PrhiCubic cubic, real v, PrhiPoint p, PrhiStep found, OUT(PrhiHit) hit) {
    // The depth of the entry as the next point will see it; on thin hair the step is many radii long.
    real side = found.s > found.dv * p.d.z ? real(1) : real(-1);
    // Possibly beyond the piece by the tolerance: neighbours overlap rather than leave a crack.
    real better_v = v + found.dv;
    PrhiPoint better = prhi_point(cubic, better_v, true);
    real s = side * sqrt(max(prhi_inside(better.c), real(0)));
    real w = better.c.x * better.d.x + better.c.y * better.d.y;
    real slope = better.d.x * better.d.x + better.d.y * better.d.y + better.c.x * better.second.x +
                 better.c.y * better.second.y - s * better.second.z -
                 better.d.z * (better.c.w * better.d.w - w) / s;
    real step = (s * better.d.z - w) / slope;
    // So short that the derivative carries point and radius along. Longer ones (or NaN) come from the
    // silhouette, where entry and exit meet and Newton has no say.
    real change = dot(real3(better.d), real3(better.d)) + better.d.w * better.d.w;
    if (step * step * change <= real(0.01) * s * s) {
        better_v = better_v + step;
        better.c = better.c + better.d * step;
    }
    real inside = prhi_inside(better.c);
    bool is_hit = true;
    if (inside >= real(0)) {
        s = side * sqrt(inside);
        hit.v = better_v;
        hit.z = better.c.z + s;
        hit.normal = prhi_normal(better, s, true);
    } else {
        is_hit = prhi_is_on_cone(p, found);
        hit.v = v;
        hit.z = p.c.z + found.s;
        hit.normal = prhi_normal(p, found.s, true);
    }
    return is_hit && hit.normal.z <= real(0);
}

// Iterates from the end that is nearer along the ray and, when that fails, from the other. Hits in front of
// z_min are failures. low and high bound v.
FUNCTION bool prhi_search(PrhiCubic cubic, real low, real high, real z_min, uint iterations, bool robust,
                          OUT(real) v, OUT(PrhiPoint) p, OUT(PrhiStep) found) {
    bool from_low = cubic.p3.z > cubic.p0.z;
    bool second_start = false;
    v = from_low ? low : high;
    real old_v = v;
    real old_dv = real(0);
    uint i = 0u;
    // Both starts share one loop, so that rays in lock-step stay together.
    for (uint count = 0u; count < 2u * iterations; ++count) {
        p = prhi_point(cubic, v, robust);
        if (robust) {
            found = prhi_robust_step(p.c, p.d);
            // 0/0: step over it.
            if (!(abs(found.dv) <= real(1e18))) {
                found.dv = from_low ? real(0.125) : real(-0.125);
                found.enters = false;
            }
        } else {
            found = prhi_published_step(p.c, p.d);
        }
        COUNT_ITERATION
        bool converged = abs(found.dv) < prhi_tolerance();
        if (converged && found.enters && p.c.z + found.s >= z_min) return true;
        real dv = clamp(found.dv, real(-0.5), real(0.5));
        real next = v + dv;
        if (old_dv * dv < real(0))
            next = (i & 3u) == 0u ? real(0.5) * (old_v + v) : (dv * old_v - old_dv * v) / (dv - old_dv);
        bool failed = converged && (robust || found.enters);
        if (robust) {
            next = clamp(next, low, high);
            failed = failed || next == v;  // leaves the interval (or cannot move any more)
        } else {
            failed = failed || !(next >= low && next <= high);
        }
        old_v = v;
        old_dv = dv;
        v = next;
        ++i;
        if (failed || i == iterations) {
            if (second_start) return false;
            second_start = true;
            from_low = !from_low;
            v = from_low ? low : high;
            old_v = v;
            old_dv = real(0);
            i = 0u;
        }
    }
    return false;
}

// The first entry through the side of the tube.
FUNCTION bool prhi_side(PrhiCubic cubic, real low, real high, real z_min, uint iterations, bool robust,
                        OUT(PrhiHit) hit) {
    real v;
    PrhiPoint p;
    PrhiStep found;
    if (!prhi_search(cubic, low, high, z_min, iterations, robust, v, p, found)) return false;
    if (robust) return prhi_polish(cubic, v, p, found, hit);
    hit.z = p.c.z + found.s;
    hit.v = v;
    hit.normal = prhi_normal(p, found.s, false);
    return hit.normal.z <= real(2);  // false where a tip of radius 0 has none
}

// The disc across a strand end, for a ray that enters there; outward is the direction out of the strand.
FUNCTION bool prhi_cap(real4 c, real3 outward, real v, real z_min, OUT(PrhiHit) hit) {
    real s = (c.x * outward.x + c.y * outward.y) / outward.z;
    hit.z = c.z + s;
    hit.v = v;
    hit.normal = normalize(outward);
    return outward.z < real(0) && c.x * c.x + c.y * c.y + s * s <= c.w * c.w && hit.z >= z_min;
}

// The direction in which a curve leaves its end `at`, from the nearest control point that differs.
FUNCTION real3 prhi_end_direction(real4 at, real4 near, real4 middle, real4 far) {
    real3 first = real3(at) - real3(near);
    real3 second = real3(at) - real3(middle);
    real3 third = real3(at) - real3(far);
    real small = real(1e-10) * max(dot(second, second), dot(third, third));
    if (dot(first, first) > small) return first;
    return dot(second, second) > small ? second : third;
}

// Whether the tangent vanishes at an end: the first edge of the control polygon against the others.
FUNCTION bool prhi_stands_still(real4 at, real4 near, real4 middle, real4 far) {
    real3 first = real3(near) - real3(at);
    real3 second = real3(middle) - real3(at);
    real3 third = real3(far) - real3(at);
    return dot(first, first) <= real(1e-10) * max(dot(second, second), dot(third, third));
}

// One piece of a curve against a ray: entering hits with tmin <= t < tmax. u counts along the whole curve.
SELDOM bool prhi_intersect(real3 origin, real3 direction, real tmin, real tmax, real4 p0, real4 p1, real4 p2,
                           real4 p3, real first_u, real last_u, bool robust, uint iterations, bool cap_start,
                           bool cap_end, OUT(real) t, OUT(real) u, OUT(real3) normal) {
    RayFrame frame;
    if (robust) {
        CurvePowers powers = curve_powers(p1 - p0, p2 - p0, p3 - p0);
        real3 middle = real3(curve_offset(powers, real(0.5) * (first_u + last_u)));
        frame = make_ray_frame(origin, direction, real3(p0), middle);
    } else {
        // The published frame has its origin at the ray's: everything is relative to it, near or far.
        frame = make_ray_frame(origin, direction, origin, real3(real(0)));
    }
    PrhiCubic cubic;
    cubic.p0 = real4(to_frame(frame, real3(p0)), p0.w);
    cubic.p1 = real4(to_frame(frame, real3(p1)), p1.w);
    cubic.p2 = real4(to_frame(frame, real3(p2)), p2.w);
    cubic.p3 = real4(to_frame(frame, real3(p3)), p3.w);
    if (last_u - first_u < real(1)) cubic = prhi_part(cubic, first_u, last_u);
    if (prhi_passes(cubic)) return false;

    real low = real(0);
    real high = real(1);
    if (robust) {
        // The cone of a point without a tangent is undefined: stay a little away from it.
        if (prhi_stands_still(cubic.p0, cubic.p1, cubic.p2, cubic.p3)) low = real(1e-4);
        if (prhi_stands_still(cubic.p3, cubic.p2, cubic.p1, cubic.p0)) high = real(1) - real(1e-4);
    }
    real z_min = (tmin - frame.t_foot) / frame.inv_length;
    PrhiHit hit;
    PrhiHit other;
    bool found = prhi_side(cubic, low, high, z_min, iterations, robust, hit);
    if (cap_start) {
        real3 outward = prhi_end_direction(cubic.p0, cubic.p1, cubic.p2, cubic.p3);
        if (prhi_cap(cubic.p0, outward, real(0), z_min, other) && !(found && hit.z <= other.z)) {
            hit = other;
            found = true;
        }
    }
    if (cap_end) {
        real3 outward = prhi_end_direction(cubic.p3, cubic.p2, cubic.p1, cubic.p0);
        if (prhi_cap(cubic.p3, outward, real(1), z_min, other) && !(found && hit.z <= other.z)) {
            hit = other;
            found = true;
        }
    }
    if (!found) return false;
    t = ray_parameter(frame, hit.z);
    u = mix(first_u, last_u, clamp(hit.v, real(0), real(1)));
    normal = from_frame(frame, normal_or_facing(hit.normal));
    return t >= tmin && t < tmax;
}
