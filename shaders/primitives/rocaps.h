// Code header: what both variants of roving capsules share: the cubic in the frame of the ray, and the
// elimination of its parts that the ray cannot meet (Reshetov & Hart 2024). The ray is the z axis.

// Control points (x, y, z, radius) of a cubic Bezier curve in the frame of the ray.
struct FrameCubic {
    real4 p0;
    real4 p1;
    real4 p2;
    real4 p3;
};

FUNCTION real4 lerp4(real4 a, real4 b, real u) { return a * (real(1) - u) + b * u; }
FUNCTION real lerp(real a, real b, real u) { return a * (real(1) - u) + b * u; }

FUNCTION real4 cubic_point(FrameCubic c, real u) {
    real4 q0 = lerp4(c.p0, c.p1, u);
    real4 q1 = lerp4(c.p1, c.p2, u);
    real4 q2 = lerp4(c.p2, c.p3, u);
    return lerp4(lerp4(q0, q1, u), lerp4(q1, q2, u), u);
}

// Point and first two derivatives (de Casteljau).
FUNCTION real4 cubic_jet(FrameCubic c, real u, OUT(real4) first, OUT(real4) second) {
    real4 q0 = lerp4(c.p0, c.p1, u);
    real4 q1 = lerp4(c.p1, c.p2, u);
    real4 q2 = lerp4(c.p2, c.p3, u);
    real4 s0 = lerp4(q0, q1, u);
    real4 s1 = lerp4(q1, q2, u);
    first = (s1 - s0) * real(3);
    second = ((q2 - q1) - (q1 - q0)) * real(6);
    return lerp4(s0, s1, u);
}

FUNCTION real4 cubic_second_derivative(FrameCubic c, real u) {
    real4 start = (c.p2 - c.p1) - (c.p1 - c.p0);
    real4 end = (c.p3 - c.p2) - (c.p2 - c.p1);
    return lerp4(start, end, u) * real(6);
}

// Distance of a curve point from the ray line.
FUNCTION real axis_distance(real4 p) { return sqrt(p.x * p.x + p.y * p.y); }

// A lower bound, on a concave piece [left, right] of the cubic b0 + c1 s + c2 s^2 + c3 s^3 that is positive
// on the left and not on the right, of its root: a Newton step from the right stays right of the root, the
// chord from the left end to that point stays left of it.
FUNCTION real concave_root_bound(real b0, real c1, real c2, real c3, real left, real right) {
    real value_left = ((c3 * left + c2) * left + c1) * left + b0;
    real value_right = ((c3 * right + c2) * right + c1) * right + b0;
    real slope = (real(3) * c3 * right + real(2) * c2) * right + c1;
    real s = right - value_right / slope;
    if (!(s >= left && s <= right)) s = right;
    real value = ((c3 * s + c2) * s + c1) * s + b0;
    real fall = value_left - value;
    return value_left > real(0) && fall > real(0) ? min(left + (s - left) * (value_left / fall), s) : left;
}

// A lower bound in [0, 1] of the first root of the cubic with Bernstein coefficients b0 > 0, b1, b2, b3; 2
// when it has none there. Convex parts by Newton from the left, concave parts by the chord: both
// stay on the near side of the root.
FUNCTION real first_root_bound(real b0, real b1, real b2, real b3) {
    if (b1 >= real(0) && b2 >= real(0) && b3 >= real(0)) return real(2);
    real c1 = real(3) * (b1 - b0);
    real c2 = real(3) * ((b2 - b1) - (b1 - b0));
    real c3 = ((b3 - b2) - (b2 - b1)) - ((b2 - b1) - (b1 - b0));
    real inflection = -c2 / (real(3) * c3);
    bool bends_back = inflection > real(0) && inflection < real(1);
    if (c2 > real(0) || (c2 == real(0) && c3 > real(0))) {  // convex at the start
        real end = bends_back ? inflection : real(1);
        real s = real(0);
        real value = b0;
        real slope = c1;
        ROLLED for (int i = 0; i < 3; ++i) {
            s = slope < real(0) ? s - value / slope : real(2);  // once it rises, it is positive up to `end`
            if (!(s < end)) break;
            value = ((c3 * s + c2) * s + c1) * s + b0;
            slope = (real(3) * c3 * s + real(2) * c2) * s + c1;
        }
        if (s < end) return s;
        if (!bends_back || b3 > real(0)) return real(2);
        return concave_root_bound(b0, c1, c2, c3, inflection, real(1));
    }
    if (!bends_back) return b3 >= real(0) ? real(2) : concave_root_bound(b0, c1, c2, c3, real(0), real(1));
    real value = ((c3 * inflection + c2) * inflection + c1) * inflection + b0;
    if (value < real(0)) return concave_root_bound(b0, c1, c2, c3, real(0), inflection);
    real slope = (real(3) * c3 * inflection + real(2) * c2) * inflection + c1;
    if (!(slope < real(0))) return real(2);
    real s = inflection - value / slope;
    return s <= real(1) ? s : real(2);
}

// Where in (u, end] the ray line can first meet a ball, given that it passes the one at u (centre p at
// `distance` > radius + slack): the ball must reach across the plane through the ray line that faces p.
// A lower bound; 2 when it can nowhere.
FUNCTION real next_possible_u(FrameCubic c, real4 p, real distance, real slack, real u, real end) {
    real nx = p.x / distance;
    real ny = p.y / distance;
    real g1 = nx * c.p1.x + ny * c.p1.y - c.p1.w - slack;
    real g2 = nx * c.p2.x + ny * c.p2.y - c.p2.w - slack;
    real g3 = nx * c.p3.x + ny * c.p3.y - c.p3.w - slack;
    // Bernstein coefficients on [u, 1], then on [u, end].
    real q1 = lerp(g1, g2, u);
    real b3 = g3;
    real b2 = lerp(g2, g3, u);
    real b1 = lerp(q1, b2, u);
    real b0 = distance - p.w - slack;
    if (end < real(1)) {
        real v = (end - u) / (real(1) - u);
        real s0 = lerp(b0, b1, v);
        real s1 = lerp(b1, b2, v);
        real s2 = lerp(b2, b3, v);
        real t0 = lerp(s0, s1, v);
        b1 = s0;
        b2 = t0;
        b3 = lerp(t0, lerp(s1, s2, v), v);
    }
    real s = first_root_bound(b0, b1, b2, b3);
    return s <= real(1) ? u + s * (end - u) : real(2);
}
