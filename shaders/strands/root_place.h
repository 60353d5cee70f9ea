// Code header, after hair_strand.h: where a strand is rooted on its face.

// One sample of the set of the unit square or triangle on a face: beyond the set's end (not the first round)
// shifted on the torus, then under one of the symmetries of the square (8) or of the triangle (6), chosen by
// key.
FUNCTION real2 placed_sample(real2 stored, real2 shift, bool is_first_round, bool is_triangle, uint key) {
    PRECISE real x = stored.x;
    PRECISE real y = stored.y;
    if (!is_first_round) {
        x = x + shift.x;
        y = y + shift.y;
        if (x >= real(1)) x = x - real(1);
        if (y >= real(1)) y = y - real(1);
        PRECISE real sum = x + y;
        if (is_triangle && sum > real(1)) {
            x = real(1) - x;
            y = real(1) - y;
        }
    }
    if (is_triangle) {
        PRECISE real rest = real(1) - x - y;
        uint turn = key % 3u;
        real second = turn == 0u ? x : (turn == 1u ? y : rest);
        real third = turn == 0u ? y : (turn == 1u ? rest : x);
        return key % 6u < 3u ? real2(second, third) : real2(third, second);
    }
    if ((key & 1u) != 0u) x = real(1) - x;
    if ((key & 2u) != 0u) y = real(1) - y;
    return (key & 4u) != 0u ? real2(y, x) : real2(x, y);
}

// Weights of a face's corners there; a triangle has no fourth.
FUNCTION real4 corner_weights(real2 place, bool is_triangle) {
    PRECISE real a = place.x;
    PRECISE real b = place.y;
    PRECISE real c = real(1) - a;
    if (is_triangle) {
        PRECISE real rest = c - b;
        return real4(rest, a, b, real(0));
    }
    PRECISE real d = real(1) - b;
    PRECISE real first = c * d;
    PRECISE real second = a * d;
    PRECISE real third = a * b;
    PRECISE real fourth = c * b;
    return real4(first, second, third, fourth);
}

FUNCTION real squared_distance(real2 a, real2 b) {
    PRECISE real2 d = a - b;
    PRECISE real x = d.x * d.x;
    PRECISE real y = d.y * d.y;
    PRECISE real result = x + y;
    return result;
}
