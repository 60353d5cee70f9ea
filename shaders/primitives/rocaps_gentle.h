// Code header: the entry of a ray that crosses a piece gently (piece_test.h): it is the one minimum of the
// entry depth, and Newton's method finds it from the ray's nearest point on the chord. Nearly all hits on
// hair are of this kind.

// A step of u towards a minimum of the entry depth z - sqrt(D), D = r^2 - x^2 - y^2, from the curve's jet at
// u: Newton on g = h + z' sqrt(D), h = x x' + y y' - r r', where g grows about as it does at a minimum (there
// h = -z' sqrt(D)), else the exact minimum of the tangent cone; outside the tube towards the ray line.
FUNCTION real verified_step(real4 p, real4 d, real4 dd, real inside) {
    real h = p.x * d.x + p.y * d.y - p.w * d.w;
    real lateral = d.x * d.x + d.y * d.y;
    real a = d.w * d.w - lateral;
    real e = d.z * d.z - a;
    real h_slope = p.x * dd.x + p.y * dd.y - p.w * dd.w - a;
    if (inside > real(0)) {
        real depth = sqrt(inside);
        real g = h + d.z * depth;
        real g_slope = h_slope + depth * dd.z - d.z * h / depth;
        real settled = h_slope + depth * dd.z + d.z * d.z;
        if (settled > real(0.02) * e && g_slope > real(0.5) * settled && g_slope < real(2) * settled)
            return -g / g_slope;
    }
    real along_x = p.w * d.x - d.w * p.x;
    real along_y = p.w * d.y - d.w * p.y;
    real along = sqrt(along_x * along_x + along_y * along_y);
    real turn = abs(d.x * p.y - d.y * p.x);
    real discriminant = (along - turn) * (along + turn);
    if (discriminant >= real(0) && e > real(0)) {
        real w = d.z * sqrt(discriminant / e);
        // (h + w) / a without its cancellation.
        return (h < real(0)) == (w < real(0)) ? (h + w) / a : (d.z * d.z * inside - h * h) / (e * (h - w));
    }
    return -h / abs(h_slope);
}

// Depths and positions in the frame of the ray. u goes to the parameter of the entry. One that lies beyond
// the piece [a, b] at an end where the curve goes on is the neighbouring piece's, and a miss here. False: not
// converged, search.
FUNCTION bool gentle_entry(RayJet jet, real a, real b, real z_min, bool starts_before, OUT(bool) hit,
                           OUT(real) u, OUT(real) z, OUT(real3) normal) {
    hit = false;
    u = jet.u;
    real margin = real(1e-4) * (b - a);
    ROLLED for (int i = 0; i < 8; ++i) {
        COUNT_ITERATION
        real4 p = jet_point(jet, u - jet.u);
        real4 d = jet_slope(jet, u - jet.u);
        real inside = p.w * p.w - (p.x * p.x + p.y * p.y);
        real wanted = u + verified_step(p, d, jet_bend(jet, u - jet.u), inside);
        real next = clamp(wanted, a, b);
        real moved = next - u;
        // In float within a hundredth of the way to the silhouette: after that step the depth is right to a
        // millionth.
        real enough = max(abs(inside), real(1e-4) * p.w * p.w);
        if (moved * moved * dot(real3(d), real3(d)) <= real(1000) * real_epsilon * enough) {
            bool is_neighbours = (wanted < a - margin && a > real(0)) || (wanted > b + margin && b < real(1));
            if (!(inside >= real(0)) || is_neighbours) return true;
            // The ball at a joint: for a ray that starts in the next curve's piece this is no entry.
            if (!starts_before && next != wanted) return false;
            p = p + d * moved;
            u = next;
            real depth = sqrt(max(p.w * p.w - (p.x * p.x + p.y * p.y), real(0)));
            z = p.z - depth;
            hit = z >= z_min;
            normal = normal_or_facing(real3(-p.x, -p.y, -depth) / p.w);
            return true;
        }
        u = next;
    }
    return false;
}

// The piece [a, b] of a curve against a ray where that is decided at once: the ray passes it, or crosses it
// gently. False: undecided, search (rocaps_verified). open_end: the curve ends a strand that has no caps.
FUNCTION bool rocaps_gentle(real3 origin, real3 direction, real tmin, real tmax, real4 c0, real4 c1, real4 c2,
                            real4 c3, real a, real b, bool open_end, bool early_out, bool gentle_first,
                            OUT(bool) hit, OUT(real) t, OUT(real) u, OUT(real3) normal) {
    hit = false;
    PieceView view;
    bool passes = passes_piece(origin, direction, c0, c1, c2, c3, a, b, view);
    if (early_out && passes) return true;
    RayFrame frame;
    RayJet jet;
    real thickest;
    real sagitta_squared;
    if (!gentle_first || open_end ||
        !gentle_approach(origin, direction, view, c0, a, b, frame, jet, thickest, sagitta_squared))
        return false;
    // In scenes of nanometres products of four lengths would vanish: the search scales them.
    real width = b - a;
    if (!((jet.first.x * jet.first.x + jet.first.y * jet.first.y) * width * width > real(1e-10)))
        return false;
    real z_min = (tmin - frame.t_foot) / frame.inv_length;
    bool starts_before = z_min < jet.point.z - width * abs(jet.first.z) - thickest - sqrt(sagitta_squared);
    real z;
    if (!gentle_entry(jet, a, b, z_min, starts_before, hit, u, z, normal)) return false;
    if (!hit) return true;
    normal = from_frame(frame, normal);
    t = ray_parameter(frame, z);
    hit = t >= tmin && t < tmax;
    return true;
}
