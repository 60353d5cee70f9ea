// Dense search for the first hit, in long double and by definitions instead of polynomials: what the
// reference itself is tested against.
#pragma once

#include "scene/rays.h"
#include "scene/surface.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace strandlab::brute_force {

using Real = long double;
using Vec3 = glm::vec<3, Real>;
using Vec4 = glm::vec<4, Real>;

inline constexpr Real infinity = std::numeric_limits<Real>::infinity();

struct Result {
    Real t = infinity, u = 0;
    bool hit = false;
};

/// A curve and a ray with the functions of u that the definitions need.
class Search {
  public:
    Search(const Curve& curve, const Ray& ray) : o_(ray.origin), d_(ray.direction), tmin_(ray.tmin) {
        for (int i = 0; i < 4; ++i) c_[i] = Vec4(curve[i]);
    }

    /// Swept balls: in each interval of u whose balls the ray line meets, the first entry.
    Result spheres(Caps caps) const {
        Result best;
        for (const auto& [a, b] : components()) {
            Real u = a, t = entry(a);
            const auto consider = [&](Real v) {
                if (entry(v) < t) {
                    t = entry(v);
                    u = v;
                }
            };
            const int n = 400;
            std::vector<Real> values(n + 1);
            for (int i = 0; i <= n; ++i) values[i] = entry(a + (b - a) * i / n);
            for (int i = 0; i <= n; ++i) {
                const Real low = i > 0 ? values[i - 1] : infinity, high = i < n ? values[i + 1] : infinity;
                if (values[i] > low || values[i] > high) continue;
                consider(minimum(a + (b - a) * std::max(0, i - 1) / n, a + (b - a) * std::min(n, i + 1) / n,
                                 [&](Real v) { return entry(v); }));
            }
            consider(b);
            const bool at_end = u < 1e-9L || u > 1 - 1e-9L;
            if ((at_end && caps == Caps::open) || !(at(u).w > 0)) continue;
            if (t >= tmin_ && t < best.t) best = {t, u, true};
        }
        return best;
    }

    /// Open swept discs, front faces only: points of the ray at distance r(u) from C(u), across C'(u).
    Result discs() const {
        Result best;
        for (const auto& [a, b] : components())
            for (const int side : {-1, 1}) {
                const auto f = [&](Real u) { return glm::dot(arm(u, side), slope(u)); };
                const std::vector<Real> samples = disc_samples(a, b);
                // Along a straight tapering tube the plane of every disc is met in its centre's foot: there
                // is no change of sign, only the point where the ray crosses the rim.
                for (const Real end : {a, b})
                    if (chord(end) <= 1e-8L * at(end).w &&
                        std::abs(f(end)) <= 1e-8L * glm::length(slope(end)) * at(end).w)
                        consider_disc(end, side, best);
                Real u0 = a, f0 = f(a);
                for (const Real u1 : samples) {
                    const Real f1 = f(u1);
                    if ((f0 < 0) != (f1 < 0)) consider_disc(bisected(u0, u1, f), side, best);
                    u0 = u1;
                    f0 = f1;
                }
            }
        return best;
    }

  private:
    Vec4 at(Real u) const {
        const Real v = 1 - u;
        return v * v * v * c_[0] + 3 * u * v * v * c_[1] + 3 * u * u * v * c_[2] + u * u * u * c_[3];
    }
    Vec3 bend(Real u) const {
        return Vec3(Real(6) *
                    ((1 - u) * (c_[0] - Real(2) * c_[1] + c_[2]) + u * (c_[1] - Real(2) * c_[2] + c_[3])));
    }
    Vec3 slope(Real u) const {
        const Real v = 1 - u;
        return Vec3(Real(3) *
                    (v * v * (c_[1] - c_[0]) + 2 * u * v * (c_[2] - c_[1]) + u * u * (c_[3] - c_[2])));
    }
    Real radius_slope(Real u) const {
        const Real v = 1 - u;
        return 3 *
               (v * v * (c_[1].w - c_[0].w) + 2 * u * v * (c_[2].w - c_[1].w) + u * u * (c_[3].w - c_[2].w));
    }
    /// Ray parameter nearest to C(u), and radius^2 - distance^2 of the ray line there.
    Real foot(Real u) const { return glm::dot(Vec3(at(u)) - o_, d_) / glm::dot(d_, d_); }
    Real inside(Real u) const {
        const Vec4 c = at(u);
        const Vec3 p = o_ + foot(u) * d_ - Vec3(c);
        return c.w * c.w - glm::dot(p, p);
    }
    Real chord(Real u) const { return std::sqrt(std::max(inside(u), Real(0))) / glm::length(d_); }
    Real entry(Real u) const { return foot(u) - chord(u); }
    Vec3 arm(Real u, int side) const { return o_ + (foot(u) + Real(side) * chord(u)) * d_ - Vec3(at(u)); }

    void consider_disc(Real u, int side, Result& best) const {
        const Vec3 tangent = slope(u);
        // Without a tangent there is no disc; near a fold it can be as short as the rounding of the points.
        if (!(glm::length(tangent) > 1e-12L) || !(at(u).w > 1e-12L)) return;
        const Vec3 normal = arm(u, side) / at(u).w - radius_slope(u) / glm::dot(tangent, tangent) * tangent;
        const Real t = foot(u) + Real(side) * chord(u);
        // Not by rounding alone: a ray that only touches the rim of an open end has no front face there.
        if (glm::dot(normal, d_) < -1e-8L * glm::length(d_) && t >= tmin_ && t < best.t) best = {t, u, true};
    }

    template <class Function>
    static Real minimum(Real a, Real b, const Function& f) {
        const Real golden = (std::sqrt(Real(5)) - 1) / 2;
        Real u = b - golden * (b - a), v = a + golden * (b - a), fu = f(u), fv = f(v);
        for (int i = 0; i < 80; ++i) {
            if (fu < fv) {
                b = v;
                v = u;
                fv = fu;
                u = b - golden * (b - a);
                fu = f(u);
            } else {
                a = u;
                u = v;
                fu = fv;
                v = a + golden * (b - a);
                fv = f(v);
            }
        }
        return (a + b) / 2;
    }

    template <class Function>
    static Real bisected(Real a, Real b, const Function& f) {
        const bool negative = f(a) < 0;
        for (int i = 0; i < 80; ++i) {
            const Real m = (a + b) / 2;
            ((f(m) < 0) == negative ? a : b) = m;
        }
        return (a + b) / 2;
    }

    /// Parameters of [a, b] in order: evenly spaced, and crowded about the slowest points of the curve. Where
    /// it folds back on itself, the disc makes half a turn within 1e-7 of u, and sweeps a ball.
    std::vector<Real> disc_samples(Real a, Real b) const {
        const int n = 600;
        std::vector<Real> samples;
        for (int i = 1; i <= n; ++i) samples.push_back(a + (b - a) * i / n);
        const auto slowing = [&](Real u) { return glm::dot(slope(u), bend(u)); };
        for (int i = 0; i < n; ++i) {
            const Real left = Real(i) / n, right = Real(i + 1) / n;
            if (!(slowing(left) < 0 && slowing(right) >= 0)) continue;
            const Real slowest = bisected(left, right, slowing);
            for (Real step = 1e-2L; step > 1e-15L; step *= 0.8L)
                for (const Real u : {slowest - step, slowest + step})
                    if (u > a && u < b) samples.push_back(u);
        }
        std::sort(samples.begin(), samples.end());
        return samples;
    }

    /// Intervals with inside >= 0, also those that fall between the samples.
    std::vector<std::pair<Real, Real>> components() const {
        const int n = 2000;
        std::vector<Real> values(n + 1);
        for (int i = 0; i <= n; ++i) values[i] = inside(Real(i) / n);
        std::vector<std::pair<Real, Real>> list;
        const auto f = [&](Real u) { return inside(u); };
        for (int i = 0; i <= n; ++i) {
            Real peak = Real(i) / n;
            if (values[i] < 0) {
                if ((i > 0 && values[i - 1] > values[i]) || (i < n && values[i + 1] > values[i])) continue;
                peak = minimum(Real(std::max(0, i - 1)) / n, Real(std::min(n, i + 1)) / n,
                               [&](Real u) { return -inside(u); });
                if (inside(peak) < 0) continue;
                // Outside at the sample itself, be it an end.
                const Real a = bisected(Real(std::max(0, i - 1)) / n, peak, f);
                const Real b = bisected(peak, Real(std::min(n, i + 1)) / n, f);
                list.emplace_back(a, b);
                continue;
            }
            int last = i;
            while (last < n && values[last + 1] >= 0) ++last;
            const Real a = i > 0 ? bisected(Real(i - 1) / n, Real(i) / n, f) : 0;
            const Real b = last < n ? bisected(Real(last) / n, Real(last + 1) / n, f) : 1;
            list.emplace_back(a, b);
            i = last;
        }
        return list;
    }

    std::array<Vec4, 4> c_;
    Vec3 o_, d_;
    Real tmin_;
};

}  // namespace strandlab::brute_force
