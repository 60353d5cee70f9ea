// Code header: whether a ray passes a piece of a swept curve by, before anything else is computed. Most
// leaves that a ray enters are left by this test: hair fills little of its boxes.

// A piece as a ray sees it first; positions are relative to the curve's first control point.
struct PieceView {
    real t_near;          // ray parameter of the ray's point nearest to that control point
    real length_squared;  // of the ray's direction
    real3 start;          // of the piece
    real3 chord;          // from there to its end
};

// Ray parameter of the ray's point nearest to the middle of the chord: depths counted from there are short.
FUNCTION real middle_parameter(real3 direction, PieceView view) {
    return view.t_near + dot(view.start + view.chord * real(0.5), direction) / view.length_squared;
}

FUNCTION real sum_of_absolutes(real3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// Whether the plane through the ray, parallel to the chord, has the piece on one side: the chord is at
// `chord_at` from it, the piece between chord_at + low and chord_at + high (all times |normal|), its surface
// within `reach` of that. size bounds the coordinates that the numbers come from. False where anything is not
// a number.
FUNCTION bool is_beside(real3 direction, real3 normal, real3 away, real3 near, real size, real low, real high,
                        real reach) {
    real normal_squared = dot(normal, normal);
    real error = real(8) * real_epsilon;
    real limit = (reach + error * (sum_of_absolutes(away) + size)) * sqrt(normal_squared) +
                 error * size * sum_of_absolutes(near) * sqrt(dot(direction, direction));
    // Below, squares lose their digits.
    return normal_squared > real(1e-30) && max(low, -high) > limit;
}

// The piece [a, b] of a cubic, swept by balls (or the discs inside them). What the curve is off its chord, in
// the direction of the plane's normal, is a cubic with the second derivatives of the whole; its inner
// Bernstein coefficients count at most 3/4.
FUNCTION bool passes_piece(real3 origin, real3 direction, real4 p0, real4 p1, real4 p2, real4 p3, real a,
                           real b, OUT(PieceView) view) {
    real3 g1 = real3(p1) - real3(p0);
    real3 g2 = real3(p2) - real3(p0);
    real3 g3 = real3(p3) - real3(p0);
    real rest_a = real(1) - a;
    real rest_b = real(1) - b;
    real a1 = real(3) * a * rest_a * rest_a;
    real a2 = real(3) * a * a * rest_a;
    real a3 = a * a * a;
    real b1 = real(3) * b * rest_b * rest_b;
    real b2 = real(3) * b * b * rest_b;
    real b3 = b * b * b;
    view.start = g1 * a1 + g2 * a2 + g3 * a3;
    view.chord = g1 * (b1 - a1) + g2 * (b2 - a2) + g3 * (b3 - a3);
    real3 normal = cross(direction, view.chord);
    real3 away = real3(p0) - origin;
    view.length_squared = dot(direction, direction);
    view.t_near = dot(away, direction) / view.length_squared;
    // From the ray's nearest point: far origins then cost digits of this vector only, not of the products
    // below.
    real3 near = away - direction * view.t_near;
    real h1 = dot(g1, normal);
    real h2 = dot(g2, normal);
    real h3 = dot(g3, normal);
    real chord_at = dot(near, normal) + a1 * h1 + a2 * h2 + a3 * h3;
    real width = b - a;
    real quarter = real(0.25) * width * width;
    real bend_start = h2 - real(2) * h1;
    real bend_end = (h3 - h2) - (h2 - h1);
    real bend_a = quarter * mix(bend_start, bend_end, a);
    real bend_b = quarter * mix(bend_start, bend_end, b);
    real first = -(real(2) * bend_a + bend_b);
    real second = -(bend_a + real(2) * bend_b);
    // Radii lie below the line through the outer ones, raised by what the inner ones are above it.
    real third = real(1.0 / 3.0);
    real raised = max(p1.w - mix(p0.w, p3.w, third), p2.w - mix(p3.w, p0.w, third));
    real reach = max(mix(p0.w, p3.w, a), mix(p0.w, p3.w, b)) + max(raised, real(0));
    real size = sum_of_absolutes(g1) + sum_of_absolutes(g2) + sum_of_absolutes(g3);
    return is_beside(direction, normal, away, near, size, chord_at + min(real(0), min(first, second)),
                     chord_at + max(real(0), max(first, second)), reach);
}

// The same for a straight piece.
FUNCTION bool passes_straight(real3 origin, real3 direction, real4 start, real4 end, OUT(PieceView) view) {
    view.start = real3(real(0));
    view.chord = real3(end) - real3(start);
    real3 normal = cross(direction, view.chord);
    real3 away = real3(start) - origin;
    view.length_squared = dot(direction, direction);
    view.t_near = dot(away, direction) / view.length_squared;
    real3 near = away - direction * view.t_near;
    real chord_at = dot(near, normal);
    return is_beside(direction, normal, away, near, sum_of_absolutes(view.chord), chord_at, chord_at,
                     max(start.w, end.w));
}

// Whether a ray along z crosses a piece so that it meets its solid at most once, entering at one place: at an
// angle that is not small, where the piece turns little, is thin against its bend and tapers little. chord is
// the piece's; bend_squared bounds |C''|^2 (b - a)^4; radius and its change along the piece are given.
FUNCTION bool crosses_gently(real3 chord, real bend_squared, real radius, real change) {
    real lateral = chord.x * chord.x + chord.y * chord.y;
    real length_squared = lateral + chord.z * chord.z;
    return lateral > real(0.05) * length_squared && bend_squared < real(0.25) * length_squared &&
           radius * sqrt(bend_squared) < real(0.1) * lateral && change * change < real(0.1) * lateral;
}

// Bounds |C''|^2 of a cubic by its control points.
FUNCTION real bend_bound(real3 p0, real3 p1, real3 p2, real3 p3) {
    real3 start = (p2 - p1) - (p1 - p0);
    real3 end = (p3 - p2) - (p2 - p1);
    return real(36) * max(dot(start, start), dot(end, end));
}
