// Code header, after hair_strand.h: from the points of a strand to its curves.

// Control points (x, y, z, radius) of one cubic, as curves are stored.
struct CurveRecord {
    real4 b0;
    real4 b1;
    real4 b2;
    real4 b3;
};

// Curves overshoot; radii must not.
FUNCTION real4 with_radius(real4 b) { return real4(b.x, b.y, b.z, b.w > real(0) ? b.w : real(0)); }

// The piece from point a to point b of the uniform Catmull-Rom curve whose end pieces are parabolas. before
// and after are the points beside them: not read where the strand begins or ends.
FUNCTION CurveRecord curve_between(real4 before, real4 a, real4 b, real4 after, bool begins, bool ends) {
    PRECISE real4 third = (b - a) * real(0.3333333432674408);
    PRECISE real4 first = third;
    PRECISE real4 last = third;
    if (!begins) first = inner_step(before, b);
    if (!ends) last = inner_step(a, after);
    if (begins && !ends) first = end_step(a, b, after);
    if (ends && !begins) last = -end_step(b, a, before);
    PRECISE real4 second_point = a + first;
    PRECISE real4 third_point = b - last;
    CurveRecord record;
    record.b0 = with_radius(a);
    record.b1 = with_radius(second_point);
    record.b2 = with_radius(third_point);
    record.b3 = with_radius(b);
    return record;
}

FUNCTION real4 middle_of(real4 a, real4 b) {
    PRECISE real4 result = (a + b) * real(0.5);
    return result;
}

FUNCTION real4 moved_towards(real4 from, real4 to, real part) {
    PRECISE real4 way = (to - from) * part;
    PRECISE real4 result = from + way;
    return result;
}

// A curve on its way (part: 0 to 1) to one half of the curve that stands for it and its neighbour at the next
// level of detail.
FUNCTION CurveRecord morphed(CurveRecord fine, CurveRecord coarse, bool is_second_half, real part) {
    real4 ab = middle_of(coarse.b0, coarse.b1);
    real4 bc = middle_of(coarse.b1, coarse.b2);
    real4 cd = middle_of(coarse.b2, coarse.b3);
    real4 abc = middle_of(ab, bc);
    real4 bcd = middle_of(bc, cd);
    real4 middle = middle_of(abc, bcd);
    CurveRecord record;
    record.b0 = moved_towards(fine.b0, is_second_half ? middle : coarse.b0, part);
    record.b1 = moved_towards(fine.b1, is_second_half ? bcd : ab, part);
    record.b2 = moved_towards(fine.b2, is_second_half ? cd : abc, part);
    record.b3 = moved_towards(fine.b3, is_second_half ? coarse.b3 : middle, part);
    return record;
}
