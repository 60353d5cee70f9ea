// Code header: the entry of a ray that crosses a piece gently (shared/piece_test.h): the cones of the phantom
// ray-hair intersector from one start, where the piece is nearest to the ray. Nearly all hits on hair are of
// this kind.

// d, from the jet's own parameter, goes to that of the last cone. An iteration that ends on a phantom, or
// leaves the piece [a, b], is a miss. False: not converged, search.
FUNCTION bool prhi_gentle(RayJet jet, real a, real b, OUT(bool) hit, OUT(real) d, OUT(PrhiPoint) p,
                          OUT(PrhiStep) found) {
    hit = false;
    d = real(0);
    real tolerance = max(real(400) * real_epsilon, real(1e-9)) * (b - a);  // no polish follows
    for (int i = 0; i < 8; ++i) {
        COUNT_ITERATION
        p.c = jet_point(jet, d);
        p.d = jet_slope(jet, d);
        found = prhi_robust_step(p.c, p.d);
        real next = clamp(jet.u + d + found.dv, a, b) - jet.u;
        if (abs(found.dv) < tolerance || next == d) {
            hit = abs(found.dv) < tolerance && found.enters;
            return true;
        }
        d = next;
    }
    return false;
}

// The piece [a, b] of a curve against a ray where that is decided at once: the ray passes it, or crosses it
// gently. False: undecided, search.
FUNCTION bool prhi_at_once(real3 origin, real3 direction, real tmin, real tmax, real4 p0, real4 p1, real4 p2,
                           real4 p3, real a, real b, bool early_out, bool gentle_first, OUT(bool) hit,
                           OUT(real) t, OUT(real) u, OUT(real3) normal) {
    hit = false;
    PieceView view;
    bool passes = passes_piece(origin, direction, p0, p1, p2, p3, a, b, view);
    if (early_out && passes) return true;
    RayFrame frame;
    RayJet jet;
    real thickest;
    real sagitta_squared;
    if (!gentle_first ||
        !gentle_approach(origin, direction, view, p0, a, b, frame, jet, thickest, sagitta_squared))
        return false;
    real d;
    PrhiPoint p;
    PrhiStep found;
    if (!prhi_gentle(jet, a, b, hit, d, p, found)) return false;
    if (!hit) return true;
    t = ray_parameter(frame, p.c.z + found.s);
    u = clamp(jet.u + d + found.dv, a, b);
    p.second = jet_bend(jet, d);
    normal = from_frame(frame, normal_or_facing(prhi_normal(p, found.s, true)));
    hit = t >= tmin && t < tmax;
    return true;
}
