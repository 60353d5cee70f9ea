// Where a ray meets a swept sphere or disc: all roots, by isolation in Bernstein form.
//
// The ray is the z axis. With C = (x, y, z), radius r, D = r^2 - x^2 - y^2 and
// h = x x' + y y' - lambda r r' (lambda 1: spheres, 0: discs), the points of the surface on the ray are
// z -+ sqrt(D) at the roots of h +- z' sqrt(D), hence of the polynomial H = z'^2 D - h^2 of degree 10.
#pragma once

#include "trace/bernstein.h"

#include <cassert>

namespace strandlab::oracle {

/// A swept piece in the frame of the ray, u in [0, 1].
template <class Real>
struct Swept {
    Cubic<Real> x, y, z, r;

    Swept on(Real a, Real b) const {
        return {restricted(x, a, b), restricted(y, a, b), restricted(z, a, b), restricted(r, a, b)};
    }
    /// D(u), without the cancellation of its definition.
    Real inside(Real u) const {
        const Real radius = evaluate(r, u), px = evaluate(x, u), py = evaluate(y, u),
                   distance = std::sqrt(px * px + py * py);
        return (radius - distance) * (radius + distance);
    }
    /// sqrt(D(u)), 0 outside.
    Real half_chord(Real u) const {
        const Real d = inside(u);
        return d > 0 ? std::sqrt(d) : Real(0);
    }
    /// Radii at and below this are rounding noise of a tip of radius zero, which is no surface.
    Real least_radius() const {
        return 8 * std::numeric_limits<Real>::epsilon() *
               std::max(std::max(r[0], r[1]), std::max(r[2], r[3]));
    }
    /// h(u).
    Real drift(Real u, Real lambda) const {
        return evaluate(x, u) * slope(x, u) + evaluate(y, u) * slope(y, u) -
               lambda * evaluate(r, u) * slope(r, u);
    }
};

/// A parameter interval of a piece under subdivision: the piece on it.
template <class Real>
struct SweptPart {
    Swept<Real> s;
    Real a, b;
    int depth = 0;
    int tight_levels = 0;  // of these levels, how many saw D well scaled

    Real middle() const { return a + Real(split_ratio) * (b - a); }
    /// Whether there is a number between the ends to split at.
    bool can_be_split() const { return middle() > a && middle() < b; }
    void split_into(SweptPart& left, SweptPart& right) const {
        split(s.x, Real(split_ratio), left.s.x, right.s.x);
        split(s.y, Real(split_ratio), left.s.y, right.s.y);
        split(s.z, Real(split_ratio), left.s.z, right.s.z);
        split(s.r, Real(split_ratio), left.s.r, right.s.r);
        left.a = a;
        left.b = right.a = middle();
        right.b = b;
        left.depth = right.depth = depth + 1;
        left.tight_levels = right.tight_levels = tight_levels;
    }
};

/// A list of bounded length without allocation; what does not fit is dropped (never for exact input).
template <class T, int Capacity>
struct ShortList {
    std::array<T, Capacity> items;
    int count = 0;

    void add(const T& item) {
        if (count < Capacity) items[count++] = item;
    }
    const T* begin() const { return items.data(); }
    const T* end() const { return items.data() + count; }
};

template <class Real>
struct Interval {
    Real a, b;
};

/// Parameter intervals in which D >= 0.
template <class Real>
using Components = ShortList<Interval<Real>, 8>;

/// Parameters at which a surface point may lie.
template <class Real>
using Roots = ShortList<Real, 32>;

/// Scaled coefficients of D.
template <class Real>
Scaled<Real, 6> inside_coefficients(const Cubic<Real>& x, const Cubic<Real>& y, const Cubic<Real>& r) {
    Scaled<Real, 6> d{};
    const auto sx = scaled(x), sy = scaled(y), sr = scaled(r);
    add_product<Real, 3, 3>(d, sr, sr, Real(1));
    add_product<Real, 3, 3>(d, sx, sx, Real(-1));
    add_product<Real, 3, 3>(d, sy, sy, Real(-1));
    return d;
}

/// Smallest and largest Bernstein coefficient of D, and the rounding noise they carry.
template <class Real>
struct InsideRange {
    Real low, high, noise;

    InsideRange(const Scaled<Real, 6>& d, const Cubic<Real>& x, const Cubic<Real>& y, const Cubic<Real>& r) {
        constexpr Real weights[7] = {1, Real(1) / 6, Real(1) / 15, Real(1) / 20, Real(1) / 15, Real(1) / 6,
                                     1};
        low = high = d[0];
        for (int i = 1; i < 7; ++i) {
            low = std::min(low, d[i] * weights[i]);
            high = std::max(high, d[i] * weights[i]);
        }
        Real size = 0;
        for (int i = 0; i < 4; ++i) size = std::max({size, std::abs(x[i]), std::abs(y[i]), std::abs(r[i])});
        noise = 4 * std::numeric_limits<Real>::epsilon() * size * size;
    }
    /// Certainly D < 0 everywhere (or, where all is noise, not above 0).
    bool is_outside() const { return high < 0 && (high < -noise || low > -noise); }
};

/// Whether D < 0 for all u in [a, b]: a cheap certain miss.
template <class Real>
bool misses(const Swept<Real>& s, Real a, Real b) {
    const Cubic<Real> x = restricted(s.x, a, b), y = restricted(s.y, a, b), r = restricted(s.r, a, b);
    return InsideRange<Real>(inside_coefficients(x, y, r), x, y, r).is_outside();
}

template <class Real>
void add_component(Components<Real>& list, Real a, Real b) {
    if (list.count > 0 && a <= list.items[list.count - 1].b)
        list.items[list.count - 1].b = std::max(b, list.items[list.count - 1].b);
    else
        list.add({a, b});
}

/// All parameter intervals with D >= 0, in order.
template <class Real>
Components<Real> find_components(const Swept<Real>& s) {
    constexpr int max_depth = std::numeric_limits<Real>::digits > 53 ? 56 : 46;
    struct Part {
        Cubic<Real> x, y, r;
        Real a, b;
        int depth;
    };
    std::array<Part, max_depth + 2> stack;
    int size = 0;
    stack[size++] = {s.x, s.y, s.r, Real(0), Real(1), 0};
    Components<Real> list;
    const auto inside = [&](Real u) { return s.inside(u); };
    for (int parts = 0; size > 0; ++parts) {
        const Part part = stack[--size];
        const Scaled<Real, 6> d = inside_coefficients(part.x, part.y, part.r);
        const InsideRange<Real> range(d, part.x, part.y, part.r);
        if (range.is_outside()) continue;
        if (range.low >= 0) {
            add_component(list, part.a, part.b);
            continue;
        }
        // A zero at an end where D is negative beside it: a ray that touches the ball there.
        const int sign = leading_sign(d), variations = sign_variations(d);
        if (d.front() == 0 && sign < 0) add_component(list, part.a, part.a);
        if (variations == 0) {
            if (d.back() == 0) add_component(list, part.b, part.b);
            continue;
        }
        if (variations == 1) {
            const Real root = bracketed_root(inside, part.a, part.b, sign);
            if (sign > 0)
                add_component(list, part.a, root);
            else
                add_component(list, root, part.b);
            if (sign > 0 && d.back() == 0) add_component(list, part.b, part.b);
            continue;
        }
        const Real middle = part.a + Real(split_ratio) * (part.b - part.a);
        if (part.depth >= max_depth || parts > most_subdivisions || !(middle > part.a && middle < part.b)) {
            if (inside(middle) >= 0) add_component(list, middle, middle);
            continue;
        }
        Part& right = stack[size++];
        Part left;
        split(part.x, Real(split_ratio), left.x, right.x);
        split(part.y, Real(split_ratio), left.y, right.y);
        split(part.r, Real(split_ratio), left.r, right.r);
        right.a = left.b = middle;
        left.a = part.a;
        right.b = part.b;
        right.depth = left.depth = part.depth + 1;
        stack[size++] = left;
    }
    return list;
}

/// h + z' sqrt(D) (side = +1, entries) or h - z' sqrt(D) (side = -1, exits).
template <class Real>
Real surface_residual(const Swept<Real>& s, Real u, Real lambda, Real side) {
    return s.drift(u, lambda) + side * slope(s.z, u) * s.half_chord(u);
}

/// Newton's method on one residual, from u; stays where it does not converge within [a, b].
template <class Real>
Real polished(const Swept<Real>& s, Real u, Real a, Real b, Real lambda, Real side) {
    Real best = u, best_residual = std::abs(surface_residual(s, u, lambda, side));
    for (int step = 0; step < 8 && best_residual > 0; ++step) {
        const Real chord = s.half_chord(u);
        if (!(chord > 0)) break;
        const Real x = evaluate(s.x, u), y = evaluate(s.y, u), r = evaluate(s.r, u);
        const Real dx = slope(s.x, u), dy = slope(s.y, u), dz = slope(s.z, u), dr = slope(s.r, u);
        const Real h = s.drift(u, lambda);
        const Real dh = dx * dx + dy * dy + x * curvature(s.x, u) + y * curvature(s.y, u) -
                        lambda * (dr * dr + r * curvature(s.r, u));
        const Real half_dd = r * dr - x * dx - y * dy;  // D' / 2
        const Real g = h + side * dz * chord;
        const Real dg = dh + side * (curvature(s.z, u) * chord + dz * half_dd / chord);
        const Real next = std::min(std::max(u - g / dg, a), b);
        if (!(next == next)) break;
        u = next;
        const Real residual = std::abs(surface_residual(s, u, lambda, side));
        if (!(residual < best_residual)) break;
        best = u;
        best_residual = residual;
    }
    return best;
}

/// Roots of H on one component. Points where H only touches zero (a ray exactly perpendicular to the
/// curve: h^2 with z' = 0) are simple roots of both residuals; that is how they are found.
template <class Real>
class SurfaceRoots {
  public:
    SurfaceRoots(const Swept<Real>& swept, Interval<Real> component, Real lambda)
        : swept_(swept), lambda_(lambda), component_(component) {
        if (component.b > component.a) isolate();
    }
    const Roots<Real>& roots() const { return roots_; }

  private:
    static constexpr int max_depth = std::numeric_limits<Real>::digits > 53 ? 50 : 40;
    /// Levels below the first well-scaled interval after which remaining variations are a multiple root.
    static constexpr int levels_of_multiple_root = 20;

    using Part = SweptPart<Real>;

    void isolate() {
        std::array<Part, max_depth + 2> stack;
        int size = 0;
        stack[size++] = {swept_.on(component_.a, component_.b), component_.a, component_.b, 0, 0};
        for (int parts = 0; size > 0; ++parts) {
            Part part = stack[--size];
            if (is_settled(part)) continue;
            if (part.depth >= max_depth || part.tight_levels >= levels_of_multiple_root ||
                parts > most_subdivisions || !part.can_be_split()) {
                add_multiple(part, part.middle());
                continue;
            }
            part.split_into(stack[size + 1], stack[size]);
            size += 2;
        }
    }

    /// Whether all roots of the part are found; notes whether D is well scaled on it.
    bool is_settled(Part& part) {
        const Scaled<Real, 6> d = inside_coefficients(part.s.x, part.s.y, part.s.r);
        const InsideRange<Real> range(d, part.s.x, part.s.y, part.s.r);
        if (range.is_outside()) return true;
        const auto sx = scaled_slope(part.s.x), sy = scaled_slope(part.s.y), sz = scaled_slope(part.s.z);
        Scaled<Real, 5> h{};
        add_product<Real, 3, 2>(h, scaled(part.s.x), sx, Real(1));
        add_product<Real, 3, 2>(h, scaled(part.s.y), sy, Real(1));
        if (lambda_ != 0) add_product<Real, 3, 2>(h, scaled(part.s.r), scaled_slope(part.s.r), -lambda_);
        Scaled<Real, 4> zz{};
        add_product<Real, 2, 2>(zz, sz, sz, Real(1));
        Scaled<Real, 10> polynomial{};
        add_product<Real, 4, 6>(polynomial, zz, d, Real(1));
        add_product<Real, 5, 5>(polynomial, h, h, Real(-1));
        if (polynomial.front() == 0) roots_.add(part.a);
        if (polynomial.back() == 0) roots_.add(part.b);
        const int variations = sign_variations(polynomial);
        if (variations == 0) return true;
        const bool tight = range.high > 0 && range.low > -8 * range.high;
        if (variations == 1 && tight) {
            // |z'| sqrt(D) - |h| has the sign of H and simple roots.
            const auto f = [&](Real u) {
                return std::abs(slope(swept_.z, u)) * swept_.half_chord(u) -
                       std::abs(swept_.drift(u, lambda_));
            };
            roots_.add(bracketed_root(f, part.a, part.b, leading_sign(polynomial)));
            return true;
        }
        if (variations == 2 && tight && both_sides_change(part)) return true;
        if (tight) ++part.tight_levels;
        return false;
    }

    /// Two roots at most, and each residual changes its sign: one root each.
    bool both_sides_change(const Part& part) {
        int signs[2];
        for (int i = 0; i < 2; ++i) {
            const Real side = i == 0 ? Real(1) : Real(-1);
            const Real at_a = surface_residual(swept_, part.a, lambda_, side);
            const Real at_b = surface_residual(swept_, part.b, lambda_, side);
            if (!((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))) return false;
            signs[i] = at_a > 0 ? 1 : -1;
        }
        for (int i = 0; i < 2; ++i) {
            const Real side = i == 0 ? Real(1) : Real(-1);
            const auto f = [&](Real u) { return surface_residual(swept_, u, lambda_, side); };
            roots_.add(bracketed_root(f, part.a, part.b, signs[i]));
        }
        return true;
    }

    void add_multiple(const Part& part, Real middle) {
        const Real slack = part.b - part.a;
        const Real low = std::max(component_.a, part.a - slack),
                   high = std::min(component_.b, part.b + slack);
        roots_.add(middle);
        for (const Real side : {Real(1), Real(-1)})
            roots_.add(polished(swept_, middle, low, high, lambda_, side));
    }

    const Swept<Real>& swept_;
    Real lambda_;
    Interval<Real> component_;
    Roots<Real> roots_;
};

}  // namespace strandlab::oracle
