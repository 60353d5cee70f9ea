// Code header: whether a ray passes a piece of a swept curve by, before anything else is computed. Most
// leaves that a ray enters are left by this test: hair fills little of its boxes.

// A piece as a ray sees it first.
struct PieceView {
    real4 edge1;  // the curve's other control points (and radii) less the first
    real4 edge2;
    real4 edge3;
    real3 tangent;  // a third of the curve's derivative at the middle of the piece
    real3 normal;   // of the plane through ray and tangent: direction x tangent
};

FUNCTION real sum_of_absolutes(real3 v) { return abs(v.x) + abs(v.y) + abs(v.z); }

// Whether a ray has something on one side of its plane through the direction `along`, with that normal:
// between low and high (times |normal|) counted from the ray, and a surface within `reach` of that. away
// leads from the ray's origin to the point that the rest is counted from, size bounds how far it lies from
// there. False where anything is not a number.
FUNCTION bool is_beside(real3 direction, real3 along, real3 normal, real3 away, real size, real low,
                        real high, real reach) {
    real normal_squared = dot(normal, normal);
    real far = sum_of_absolutes(away);
    // Rounding of the heights; then the ray's own, which a rounded normal does not make exactly 0.
    real error = real_epsilon * (real(4) * (far + reach) + real(24) * size);
    real off = max(low, -high) - real_epsilon * (real(1.5) * far + real(4) * size) *
                                     sum_of_absolutes(direction) * sum_of_absolutes(along);
    real limit = reach + error;
    // Below, squares lose their digits.
    return normal_squared > real(1e-30) && off > real(0) && off * off > limit * limit * normal_squared;
}

// The piece [a, b] of a cubic, swept by balls (or the discs inside them). Its height over the plane is a
// cubic that does not rise at the middle: heights there, and at the ends, bound it all.
FUNCTION bool passes_piece(real3 origin, real3 direction, real4 p0, real4 p1, real4 p2, real4 p3, real a,
                           real b, OUT(PieceView) view) {
    view.edge1 = p1 - p0;
    view.edge2 = p2 - p0;
    view.edge3 = p3 - p0;
    real m = real(0.5) * (a + b);
    real square = m * m;
    real rest = real(1) - m;
    view.tangent = real3(view.edge1) * (rest * (real(1) - real(3) * m)) +
                   real3(view.edge2) * (real(2) * m - real(3) * square) + real3(view.edge3) * square;
    view.normal = cross(direction, view.tangent);
    real3 away = real3(p0) - origin;
    real h1 = dot(real3(view.edge1), view.normal);
    real h2 = dot(real3(view.edge2), view.normal);
    real h3 = dot(real3(view.edge3), view.normal);
    real height = dot(away, view.normal) + square * m * h3 + real(3) * m * rest * (rest * h1 + m * h2);
    real width = b - a;
    real bend_start = h2 - real(2) * h1;
    real bend_end = (h3 - h2) - (h2 - h1);
    real bend = real(0.75) * width * width * mix(bend_start, bend_end, m);
    real twist = real(0.125) * width * width * width * abs(bend_end - bend_start);
    real reach = max(max(p0.w, p1.w), max(p2.w, p3.w));
    real size = sum_of_absolutes(real3(view.edge1)) + sum_of_absolutes(real3(view.edge2)) +
                sum_of_absolutes(real3(view.edge3));
    return is_beside(direction, view.tangent, view.normal, away, size, height + min(real(0), bend) - twist,
                     height + max(real(0), bend) + twist, reach);
}

// The same for a straight piece.
FUNCTION bool passes_straight(real3 origin, real3 direction, real4 start, real4 end) {
    real3 chord = real3(end) - real3(start);
    real3 normal = cross(direction, chord);
    real3 away = real3(start) - origin;
    real height = dot(away, normal);
    return is_beside(direction, chord, normal, away, sum_of_absolutes(chord), height, height,
                     max(start.w, end.w));
}

// A curve less its first control point (and radius), in powers of u: ((cubic u + square) u + linear) u.
struct CurvePowers {
    real4 linear;
    real4 square;
    real4 cubic;
};

FUNCTION CurvePowers curve_powers(real4 edge1, real4 edge2, real4 edge3) {
    CurvePowers powers;
    powers.linear = edge1 * real(3);
    powers.square = (edge2 - edge1 * real(2)) * real(3);
    powers.cubic = edge3 + (edge1 - edge2) * real(3);
    return powers;
}

FUNCTION real4 curve_offset(CurvePowers c, real u) { return ((c.cubic * u + c.square) * u + c.linear) * u; }

// Whether a ray crosses the piece [a, a + width] so that it meets its solid at most once,
// entering at one place: at an angle that is not small, where the piece turns little, is thin against its
// bend and tapers little. radius is the curve's first, thickest bounds all; sagitta_squared bounds (8 times
// what the piece leaves its chord)^2.
FUNCTION bool crosses_gently(real3 direction, PieceView view, CurvePowers powers, real a, real width,
                             real radius, OUT(real) thickest, OUT(real) sagitta_squared) {
    real scale = real(9) * width * width;
    real length_squared = scale * dot(view.tangent, view.tangent);
    real lateral = scale * dot(view.normal, view.normal) / dot(direction, direction);
    // Halves of the second derivative at both ends of the piece.
    real3 start = real3(powers.square) + real3(powers.cubic) * (real(3) * a);
    real3 end = start + real3(powers.cubic) * (real(3) * width);
    sagitta_squared = real(4) * max(dot(start, start), dot(end, end)) * (width * width) * (width * width);
    real most = max(max(view.edge1.w, view.edge2.w), max(view.edge3.w, real(0)));
    real least = min(min(view.edge1.w, view.edge2.w), min(view.edge3.w, real(0)));
    real change = real(3) * width * (most - least);
    thickest = radius + most;
    return lateral > real(0.05) * length_squared && sagitta_squared < real(0.25) * length_squared &&
           thickest * sqrt(sagitta_squared) < real(0.1) * lateral && change * change < real(0.1) * lateral;
}
