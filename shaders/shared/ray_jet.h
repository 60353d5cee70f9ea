// Code header: a piece of a cubic as a ray that crosses it sees it: its Taylor polynomial in the frame of the
// ray, where it is about nearest to the ray. Searches that start there take a few multiplications a step, and
// keep all digits of what is near the ray.

struct RayJet {
    real u;       // the curve's parameter there
    real4 point;  // and its place and radius
    real4 first;  // point + first d + second d^2 + third d^3, at u + d
    real4 second;
    real4 third;
};

FUNCTION real4 jet_point(RayJet jet, real d) {
    return jet.point + (jet.first + (jet.second + jet.third * d) * d) * d;
}
FUNCTION real4 jet_slope(RayJet jet, real d) {
    return jet.first + (jet.second * real(2) + jet.third * (real(3) * d)) * d;
}
FUNCTION real4 jet_bend(RayJet jet, real d) { return jet.second * real(2) + jet.third * (real(6) * d); }

FUNCTION real4 turned(RayFrame frame, real4 v) { return real4(turn_to_frame(frame, real3(v)), v.w); }

// The jet of the piece [a, b] that a view shows. The frame's reference is the curve's first control point,
// whose radius is given, its foot the ray's point nearest to the middle of the piece, which lies at `middle`.
FUNCTION RayJet ray_jet(RayFrame frame, real3 direction, PieceView view, CurvePowers powers, real radius,
                        real3 middle, real a, real b) {
    RayJet jet;
    // Where the tangent at the middle is nearest to the ray.
    real along =
        dot(cross(middle - frame.foot, direction), view.normal) / (real(3) * dot(view.normal, view.normal));
    jet.u = clamp(real(0.5) * (a + b) + along, a, b);
    real4 place = curve_offset(powers, jet.u);
    jet.point = real4(turn_to_frame(frame, real3(place) - frame.foot), radius + place.w);
    real4 rise = powers.cubic * (real(3) * jet.u);
    jet.first = turned(frame, powers.linear + (powers.square * real(2) + rise) * jet.u);
    jet.second = turned(frame, powers.square + rise);
    jet.third = turned(frame, powers.cubic);
    return jet;
}

// The piece [a, b] that a view shows, of the curve that begins at p0, where the ray crosses it gently
// (crosses_gently): its jet, and the frame that this is in. False elsewhere.
FUNCTION bool gentle_approach(real3 origin, real3 direction, PieceView view, real4 p0, real a, real b,
                              OUT(RayFrame) frame, OUT(RayJet) jet, OUT(real) thickest,
                              OUT(real) sagitta_squared) {
    CurvePowers powers = curve_powers(view.edge1, view.edge2, view.edge3);
    if (!crosses_gently(direction, view, powers, a, b - a, p0.w, thickest, sagitta_squared)) return false;
    real3 middle = real3(curve_offset(powers, real(0.5) * (a + b)));
    frame = make_ray_frame(origin, direction, real3(p0), middle);
    jet = ray_jet(frame, direction, view, powers, p0.w, middle, a, b);
    return true;
}
