// Code header: roving capsules whose hits are verified on the true curve. The capsules of Reshetov & Hart
// 2024 only find candidates: each is thick enough to hold its piece of the curve, and the parameter that
// it gives is then refined on the swept sphere itself.

// Follows the entry depth downhill from u within [low, high], at most 4 steps of at most `longest`; z and
// best_u become the nearest entry met on the way, if it is nearer than z. Every point with D >= 0 is one
// of the solid, so no step can do harm.
FUNCTION void refine_entry(FrameCubic c, real low, real high, real longest, real u, INOUT(real) z,
                           INOUT(real) best_u) {
    real previous = real(0);
    ROLLED for (int i = 0; i < 5; ++i) {
        COUNT_ITERATION
        real4 d;
        real4 dd;
        real4 p = cubic_jet(c, u, d, dd);
        real distance = axis_distance(p);
        real inside = (p.w - distance) * (p.w + distance);
        if (inside >= real(0) && p.w > real(0)) {
            real entry = p.z - sqrt(inside);
            if (entry < z) {
                z = entry;
                best_u = u;
            }
        }
        real step = verified_step(p, d, dd, inside);
        if (step > longest) step = longest;
        if (step < -longest) step = -longest;
        if (!(abs(step) <= longest)) return;
        // The minimum lies ahead of the step's start; once a step turned back, that brackets it.
        if (step > real(0))
            low = u;
        else
            high = u;
        real next = u + step;
        if (step * previous < real(0) && !(next > low && next < high)) next = real(0.5) * (low + high);
        next = min(max(next, low), high);
        if (!(abs(next - u) > real_epsilon)) return;
        previous = step;
        u = next;
    }
}

// Whether the point at depth z of the ray lies inside the straight continuation of a strand beyond the
// curve's end p, for the length of the curve's tangent `away` there: rays that start there start inside.
FUNCTION bool starts_in_continuation(real4 p, real3 away, real z) {
    real3 v = real3(-p.x, -p.y, z - p.z);
    real s = dot(v, away) / dot(away, away);
    real3 off = v - away * s;
    return s >= real(0) && s <= real(1) && dot(off, off) < p.w * p.w;
}

// The part [a, b] of the curve that is searched, and the depths between which entries count.
struct VerifiedSearch {
    real a;
    real b;
    real bend;   // at least |C''| + |r''| on [a, b]
    real step;   // length of a capsule in u
    real slack;  // rounding error of positions in the frame
    real z_min;
    bool joint_start_inside;  // at u = 0 (1) the strand goes on, and the ray starts inside it there
    bool joint_end_inside;
    bool open_start;  // an entry at u = 0 (1) is none
    bool open_end;
    bool splits_runs;  // gaps within a capsule matter: a part of the solid may have to be passed as a whole
};

// Where the ray line leaves the balls of [a, b] for a moment although it meets those at a and b; b when it
// does not. The dip of D between is where h = -D' / 2 changes its sign.
FUNCTION real gap_between(FrameCubic c, real a, real b) {
    real4 d;
    real4 dd;
    real4 p = cubic_jet(c, a, d, dd);
    real h_a = p.x * d.x + p.y * d.y - p.w * d.w;
    p = cubic_jet(c, b, d, dd);
    real h_b = p.x * d.x + p.y * d.y - p.w * d.w;
    if (!(h_a > real(0) && h_b < real(0)) || axis_distance(p) > p.w) return b;
    real low = a;
    real high = b;
    ROLLED for (int i = 0; i < 4; ++i) {
        real u = (low * h_b - high * h_a) / (h_b - h_a);
        p = cubic_jet(c, u, d, dd);
        if (axis_distance(p) > p.w) return u;
        real h = p.x * d.x + p.y * d.y - p.w * d.w;
        if (h > real(0)) {
            low = u;
            h_a = h;
        } else {
            high = u;
            h_b = h;
        }
    }
    return b;
}

// Nearest entry on [a, b] with z_min <= z < z; false when there is none. A run is a stretch of capsules
// without a gap along the ray line: one connected part of the solid, whose nearest entry alone counts, so
// that rays starting inside pass it as a whole.
FUNCTION bool verified_search(FrameCubic c, VerifiedSearch search, INOUT(real) z, OUT(real) u) {
    const real far = real(3e38);
    bool found = false;
    real run_z = far;
    real run_u = search.a;
    real run_start = search.a;
    bool run_counts = !search.joint_start_inside;
    real start = search.a;
    // Where runs must not mix, a candidate stays within its capsule.
    real margin = search.splits_runs ? real(0) : real(0.125) * search.step;
    real4 p = cubic_point(c, start);
    u = start;
    // A capsule is at least 2^-12 long.
    ROLLED for (int i = 0; i < 4100; ++i) {
        real distance = axis_distance(p);
        real inside = (p.w - distance) * (p.w + distance);
        if (inside >= real(0) && p.w > real(0) && p.z - sqrt(inside) < run_z) {
            run_z = p.z - sqrt(inside);
            run_u = start;
        }
        bool finished = !(start < search.b);
        bool passes = distance > p.w + search.slack;
        // A candidate beyond the gap belongs to the run that follows.
        if (finished || (passes && run_u <= start)) {
            if (!passes && search.joint_end_inside) run_counts = false;
            bool at_open_end =
                (search.open_start && run_u <= real(0)) || (search.open_end && run_u >= real(1));
            if (run_counts && !at_open_end && run_z >= search.z_min && run_z < z) {
                z = run_z;
                u = run_u;
                found = true;
            }
            if (finished) break;
            run_z = far;
            run_counts = true;
        }
        if (passes) {
            real next = next_possible_u(c, p, distance, search.slack, start, search.b);
            if (!(next <= real(1))) break;
            next = max(start, min(next - real(1e-5), search.b - search.step));
            if (next > start) p = cubic_point(c, next);
            start = next;
            run_start = start;
        }
        COUNT_ITERATION
        real end = min(search.b, start + search.step);
        if (search.splits_runs && !passes) end = gap_between(c, start, end);
        real4 q = cubic_point(c, end);
        real length = end - start;
        real inflation = search.bend * length * length * real(0.125) + search.slack;
        RoundConeHit hit;
        // The capsule holds the piece: an entry behind what is known already cannot lead to a nearer one.
        if (round_cone_entry(real3(p), p.w + inflation, real3(q), q.w + inflation, false, false, hit) &&
            hit.z < min(z, run_z))
            refine_entry(c, max(run_start, start - margin), min(search.b, end + margin), search.step,
                         lerp(start, end, hit.u), run_z, run_u);
        start = end;
        p = q;
    }
    return found;
}

// Takes an entry (z, u) of the search to the exact minimum of the depth near it, and its normal in the frame.
// False when the minimum lies beyond the piece [a, b] at an end where the curve goes on: then it is the
// entry of the neighbouring piece.
FUNCTION bool polish_entry(FrameCubic c, VerifiedSearch search, real a, real b, INOUT(real) z, INOUT(real) u,
                           OUT(real3) normal) {
    real margin = real(1e-4) * (b - a);
    real3 best = real3(real(0));
    real best_u = u;
    ROLLED for (int i = 0; i < 4; ++i) {
        real4 d;
        real4 dd;
        real4 p = cubic_jet(c, u, d, dd);
        real distance = axis_distance(p);
        real inside = (p.w - distance) * (p.w + distance);
        real depth = sqrt(max(inside, real(0)));
        real entry = p.z - depth;
        COUNT_ITERATION
        if (i > 0 && !(inside >= real(0) && entry <= z)) break;
        z = entry;
        best_u = u;
        best = real3(-p.x, -p.y, -depth) / p.w;
        real step = verified_step(p, d, dd, inside);
        if (!(abs(step) <= real(2) * search.step)) break;
        real next = u + step;
        if (step < real(0) && next < a - margin && u <= a + margin && a > real(0)) return false;
        if (step > real(0) && next > b + margin && u >= b - margin && b < real(1)) return false;
        next = min(max(next, search.a), search.b);
        if (!(abs(next - u) > real(4) * real_epsilon)) break;
        u = next;
    }
    u = best_u;
    normal = normal_or_facing(best);
    return z >= search.z_min && u >= a - margin && u <= b + margin;
}

// Whether the ray can meet the balls on [a, b], whose end points are p and q, at depths in [z_min, z_max]:
// the chord, thick enough to hold what leaves it by at most `bulge`.
FUNCTION bool near_chord(real4 p, real4 q, real bulge, real z_min, real z_max) {
    real reach = max(p.w, q.w) + bulge;
    real dx = q.x - p.x;
    real dy = q.y - p.y;
    real length_squared = dx * dx + dy * dy;
    real s =
        length_squared > real(0) ? clamp(-(p.x * dx + p.y * dy) / length_squared, real(0), real(1)) : real(0);
    real x = p.x + s * dx;
    real y = p.y + s * dy;
    return x * x + y * y <= reach * reach && min(p.z, q.z) - reach <= z_max && max(p.z, q.z) + reach >= z_min;
}

FUNCTION real largest_bend(FrameCubic c, real a, real b) {
    real4 first = cubic_second_derivative(c, a);
    real4 last = cubic_second_derivative(c, b);
    return sqrt(max(dot(real3(first), real3(first)), dot(real3(last), real3(last)))) +
           max(abs(first.w), abs(last.w));
}

// The piece [first_u, last_u] of a curve against a ray: entering hits with tmin <= t < tmax. epsilon bounds
// how far the axis of a capsule may leave the curve, in radii.
SELDOM bool rocaps_verified(real3 origin, real3 direction, real tmin, real tmax, real4 c0, real4 c1, real4 c2,
                            real4 c3, real first_u, real last_u, bool begins_strand, bool ends_strand,
                            bool open_ends, real epsilon, OUT(real) t, OUT(real) u, OUT(real3) normal) {
    real3 reference = real3(c0);
    real3 middle = ((real3(c1) - reference) + (real3(c2) - reference) + (real3(c3) - reference)) * real(0.25);
    RayFrame frame = make_ray_frame(origin, direction, reference, middle);
    FrameCubic c;
    c.p0 = real4(to_frame(frame, real3(c0)), c0.w);
    c.p1 = real4(to_frame(frame, real3(c1)), c1.w);
    c.p2 = real4(to_frame(frame, real3(c2)), c2.w);
    c.p3 = real4(to_frame(frame, real3(c3)), c3.w);
    real4 largest = max(max(abs(c.p0), abs(c.p1)), max(abs(c.p2), abs(c.p3)));
    real unit = safe_unit(max(max(largest.x, largest.y), max(largest.z, largest.w)));
    c.p0 = c.p0 * unit;
    c.p1 = c.p1 * unit;
    c.p2 = c.p2 * unit;
    c.p3 = c.p3 * unit;
    largest = largest * unit;
    real z_max = (tmax - frame.t_foot) / frame.inv_length * unit;
    if (!(z_max < real(3e38))) z_max = real(3e38);  // long directions: beyond what stands for "no entry" yet

    VerifiedSearch search;
    search.slack = real(4) * real_epsilon * max(max(largest.x, largest.y), max(largest.z, largest.w));
    search.z_min = (tmin - frame.t_foot) / frame.inv_length * unit;
    search.a = first_u;
    search.b = last_u;
    search.bend = largest_bend(c, search.a, search.b);
    real4 p = cubic_point(c, search.a);
    real4 q = cubic_point(c, search.b);
    real width = search.b - search.a;
    real bulge = real(0.125) * search.bend * width * width + search.slack;
    if (!near_chord(p, q, bulge, search.z_min, z_max)) return false;

    // Where the ray's part of the solid can go on beyond the piece, and that matters (the ray may start
    // inside, or look into an open end), the whole curve is searched.
    search.open_start = open_ends && begins_strand;
    search.open_end = open_ends && ends_strand;
    bool crosses_a = first_u > real(0) && axis_distance(p) <= p.w + search.slack;
    bool crosses_b = last_u < real(1) && axis_distance(q) <= q.w + search.slack;
    real z_low = min(min(c.p0.z - c.p0.w, c.p1.z - c.p1.w), min(c.p2.z - c.p2.w, c.p3.z - c.p3.w));
    real z_high = max(max(c.p0.z + c.p0.w, c.p1.z + c.p1.w), max(c.p2.z + c.p2.w, c.p3.z + c.p3.w));
    bool starts_near = search.z_min >= z_low && search.z_min <= z_high;
    search.splits_runs = starts_near || search.open_start || search.open_end;
    if (crosses_a && search.splits_runs) search.a = real(0);
    if (crosses_b && search.splits_runs) search.b = real(1);
    // A ball of radius 0 is no part of the solid: stop just before such a tip.
    if (!(c.p0.w > real(0))) search.a = max(search.a, real(1.0 / 1048576.0));
    if (!(c.p3.w > real(0))) search.b = min(search.b, real(1048575.0 / 1048576.0));
    real thinnest = min(p.w, q.w);
    if (search.b - search.a > width) {
        search.bend = largest_bend(c, search.a, search.b);
        thinnest = min(c.p0.w, c.p3.w);
    }
    search.joint_start_inside = !begins_strand && search.a <= real(0) && axis_distance(c.p0) <= c.p0.w &&
                                starts_in_continuation(c.p0, real3(c.p0 - c.p1) * real(3), search.z_min);
    search.joint_end_inside = !ends_strand && search.b >= real(1) && axis_distance(c.p3) <= c.p3.w &&
                              starts_in_continuation(c.p3, real3(c.p3 - c.p2) * real(3), search.z_min);
    // A chord of length step leaves the curve by at most bend step^2 / 8.
    real radius = max(thinnest, real(0.05) * largest.w);
    search.step = real(1);
    if (search.bend > real(8) * epsilon * radius)
        search.step = sqrt(real(8) * epsilon * radius / search.bend);
    search.step = min(max(search.step, real(1.0 / 4096.0)), search.b - search.a);

    real z = z_max;
    if (!verified_search(c, search, z, u)) return false;
    if (!polish_entry(c, search, first_u, last_u, z, u, normal)) return false;
    normal = from_frame(frame, normal);
    t = ray_parameter(frame, z / unit);
    return t >= tmin && t < tmax;
}
