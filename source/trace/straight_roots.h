// The same two questions for a straight piece with linear radius (round cone), in closed form: D is a
// quadratic a u^2 - 2 f u - g, and so is H.
#pragma once

#include "trace/swept_roots.h"

namespace strandlab::oracle {

template <class Real>
class RoundCone {
  public:
    /// Uses the end points of the piece only.
    explicit RoundCone(const Swept<Real>& s) : swept_(s) {
        const Real x = s.x[0], y = s.y[0], radius = s.r[0];
        const Real ax = s.x[3] - x, ay = s.y[3] - y, dr = s.r[3] - radius;
        az_ = s.z[3] - s.z[0];
        const Real lateral = ax * ax + ay * ay, distance = std::sqrt(x * x + y * y);
        a_ = dr * dr - lateral;
        e_ = lateral + az_ * az_ - dr * dr;
        f_ = x * ax + y * ay - radius * dr;
        g_ = (distance - radius) * (distance + radius);
        // f^2 + g a by Lagrange's identity, which does not cancel.
        const Real px = radius * ax - dr * x, py = radius * ay - dr * y, turn = ax * y - ay * x;
        const Real along = std::sqrt(px * px + py * py);
        discriminant_ = (along - std::abs(turn)) * (along + std::abs(turn));
    }

    /// Where D >= 0 on [0, 1].
    Components<Real> components() const {
        Components<Real> list;
        if (discriminant_ < 0) {
            if (a_ > 0) list.add({0, 1});
            return list;
        }
        const Real q = f_ + std::copysign(std::sqrt(discriminant_), f_);
        const Real infinity = std::numeric_limits<Real>::infinity();
        if (q == 0) {  // D = a u^2, or the constant -g
            if (a_ > 0 || (a_ == 0 && g_ <= 0)) list.add({0, 1});
            if (a_ < 0 && g_ == 0) list.add({0, 0});
            return list;
        }
        const Real near_zero = -g_ / q;
        const Real other = a_ == 0 ? (f_ > 0 ? -infinity : infinity) : q / a_;
        const Real low = std::min(near_zero, other), high = std::max(near_zero, other);
        if (a_ <= 0) {
            add(list, low, high);
        } else {
            add(list, -infinity, low);
            add(list, high, infinity);
        }
        return list;
    }

    /// The stationary points of entry and exit within a component.
    Roots<Real> stationary(const Interval<Real>& component) const {
        Roots<Real> roots;
        if (!(e_ > 0 && discriminant_ >= 0)) return roots;
        const Real w = az_ * std::sqrt(discriminant_ / e_);
        add(roots, component, root(w), Real(1));
        add(roots, component, root(-w), Real(-1));
        return roots;
    }

  private:
    static void add(Components<Real>& list, Real low, Real high) {
        low = std::max(low, Real(0));
        high = std::min(high, Real(1));
        if (low <= high) list.add({low, high});
    }
    void add(Roots<Real>& roots, const Interval<Real>& component, Real u, Real side) const {
        if (u >= component.a && u <= component.b)
            roots.add(polished(swept_, u, component.a, component.b, Real(1), side));
    }
    /// (f + w) / a without cancellation.
    Real root(Real w) const {
        if ((f_ >= 0) == (w >= 0)) return (f_ + w) / a_;
        return -(f_ * f_ + az_ * az_ * g_) / (e_ * (f_ - w));
    }

    const Swept<Real>& swept_;
    Real az_, a_, e_, f_, g_, discriminant_;
};

}  // namespace strandlab::oracle
