// Polynomials in Bernstein form, scaled by their binomials so that products are plain convolutions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace strandlab::oracle {

/// Where intervals are split: an irregular ratio keeps the roots of symmetric input off the split points.
inline constexpr double split_ratio = 0.4837;

/// More parts than a subdivision needs to find all roots: what it has left then is rounding noise (a ray that
/// runs along the surface), and is decided at its middle. Without a limit that would take 2^40 of them.
inline constexpr int most_subdivisions = 20000;

/// Coefficients b_i binomial(N, i) of a polynomial of degree N on [0, 1].
template <class Real, size_t N>
using Scaled = std::array<Real, N + 1>;

/// Bezier coefficients of a cubic.
template <class Real>
using Cubic = std::array<Real, 4>;

/// The cubic with its binomials.
template <class Real>
Scaled<Real, 3> scaled(const Cubic<Real>& c) {
    return {c[0], 3 * c[1], 3 * c[2], c[3]};
}

/// A third of the derivative.
template <class Real>
Scaled<Real, 2> scaled_slope(const Cubic<Real>& c) {
    return {c[1] - c[0], 2 * (c[2] - c[1]), c[3] - c[2]};
}

/// out += factor * a * b.
template <class Real, size_t M, size_t N>
void add_product(Scaled<Real, M + N>& out, const std::array<Real, M + 1>& a, const std::array<Real, N + 1>& b,
                 Real factor) {
    for (size_t i = 0; i <= M; ++i) {
        const Real f = factor * a[i];
        for (size_t j = 0; j <= N; ++j) out[i + j] += f * b[j];
    }
}

/// Sign changes in the coefficients, zeros passed over: an upper bound of the number of roots in (0, 1)
/// that has the right parity (Descartes).
template <class Real, size_t Size>
int sign_variations(const std::array<Real, Size>& c) {
    int count = 0;
    Real last = 0;
    for (const Real x : c) {
        if (x == 0) continue;
        if ((x < 0 && last > 0) || (x > 0 && last < 0)) ++count;
        last = x;
    }
    return count;
}

/// Sign (+1, -1, 0) of the first coefficient that is not zero.
template <class Real, size_t Size>
int leading_sign(const std::array<Real, Size>& c) {
    for (const Real x : c)
        if (x != 0) return x > 0 ? 1 : -1;
    return 0;
}

template <class Real>
Real evaluate(const Cubic<Real>& c, Real u) {
    const Real v = 1 - u;
    return v * v * (v * c[0] + 3 * u * c[1]) + u * u * (3 * v * c[2] + u * c[3]);
}

template <class Real>
Real slope(const Cubic<Real>& c, Real u) {
    const Real v = 1 - u;
    return 3 * (v * v * (c[1] - c[0]) + 2 * u * v * (c[2] - c[1]) + u * u * (c[3] - c[2]));
}

template <class Real>
Real curvature(const Cubic<Real>& c, Real u) {
    return 6 * ((1 - u) * (c[2] - 2 * c[1] + c[0]) + u * (c[3] - 2 * c[2] + c[1]));
}

/// a + u (b - a): b itself at u = 1, and where both are equal just that, so that coefficients which coincide
/// (a zero end tangent, a constant coordinate) still do after any subdivision.
template <class Real>
Real between(Real a, Real b, Real u) {
    return u == 1 ? b : a + u * (b - a);
}

/// Both halves of a cubic (de Casteljau).
template <class Real>
void split(const Cubic<Real>& c, Real u, Cubic<Real>& left, Cubic<Real>& right) {
    const Real a = between(c[0], c[1], u), b = between(c[1], c[2], u), d = between(c[2], c[3], u);
    const Real ab = between(a, b, u), bd = between(b, d, u), m = between(ab, bd, u);
    left = {c[0], a, ab, m};
    right = {m, bd, d, c[3]};
}

/// The cubic on [a, b], reparametrised to [0, 1] (blossoming).
template <class Real>
Cubic<Real> restricted(const Cubic<Real>& c, Real a, Real b) {
    if (a == 0 && b == 1) return c;
    const auto blossom = [&](Real r, Real s, Real t) {
        const Real p = between(c[0], c[1], r), q = between(c[1], c[2], r), w = between(c[2], c[3], r);
        return between(between(p, q, s), between(q, w, s), t);
    };
    // An end that stays (0 or 1) comes first: it only picks coefficients.
    if (b == 1) return {blossom(a, a, a), blossom(b, a, a), blossom(b, b, a), c[3]};
    return {blossom(a, a, a), blossom(a, a, b), blossom(a, b, b), blossom(b, b, b)};
}

/// The root of f in (a, b), where f has the sign `sign_a` just right of a and the other just left of b:
/// false position (Illinois) with a bisection every third step. The values at the ends themselves may be
/// zero or rounding noise.
template <class Real, class Function>
Real bracketed_root(const Function& f, Real a, Real b, int sign_a) {
    const Real sign = Real(sign_a);
    Real fa = sign * f(a), fb = sign * f(b);  // > 0 and < 0 when they can be used
    int last_side = 0;
    for (int step = 0; step < 200; ++step) {
        const Real nudge = std::numeric_limits<Real>::epsilon() * std::max(std::abs(a), std::abs(b));
        const Real middle = a + (b - a) / 2;
        if (!(b - a > 2 * nudge) || !(middle > a && middle < b)) break;
        Real u = middle;
        if (step % 3 != 2 && fa > 0 && fb < 0) {
            // Kept off the ends, so that the bracket closes from both sides once one end is the root.
            u = std::min(std::max(a + (b - a) * (fa / (fa - fb)), a + nudge), b - nudge);
            if (!(u > a && u < b)) u = middle;
        }
        const Real fu = sign * f(u);
        if (fu == 0) return u;
        if (fu > 0) {
            a = u;
            fa = fu;
            if (last_side == 1) fb /= 2;
            last_side = 1;
        } else {
            b = u;
            fb = fu;
            if (last_side == -1) fa /= 2;
            last_side = -1;
        }
    }
    return a + (b - a) / 2;
}

}  // namespace strandlab::oracle
