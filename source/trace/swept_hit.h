// First entry of a ray into one swept piece, in the frame of the ray.
#pragma once

#include "scene/caps.h"
#include "trace/straight_roots.h"
#include "trace/swept_roots.h"

#include <glm/glm.hpp>

#include <optional>

namespace strandlab::oracle {

/// What a piece is besides its control points. Strand ends are closed as caps says; u = 0 and u = 1 of a
/// piece inside a strand are interior joints, always closed.
struct PieceEnds {
    Caps caps = Caps::round;
    bool begins_strand = false, ends_strand = false;
    bool straight = false;
};

template <class Real>
struct SweptHit {
    Real z = std::numeric_limits<Real>::infinity();  // depth
    Real u = 0, radius = 0;
    glm::vec<3, Real> normal{0};  // unit, outward
    bool on_cap = false;
};

/// The nearest front-facing hit with depth >= z_min, and whether the point at depth z_min is inside.
template <class Real>
struct SweptResult {
    SweptHit<Real> hit;
    bool found = false, starts_inside = false;

    void offer(const SweptHit<Real>& other) {
        if (found && !(other.z < hit.z)) return;
        hit = other;
        found = true;
    }
};

/// Position, radius and derivatives at one parameter.
template <class Real>
struct SweptPoint {
    using Vec3 = glm::vec<3, Real>;
    Vec3 centre, tangent;  // tangent: unit, the limit where C' vanishes; zero for a point curve
    Real radius, speed;
    bool regular;  // C' does not vanish

    SweptPoint(const Swept<Real>& s, Real u) {
        centre = Vec3(evaluate(s.x, u), evaluate(s.y, u), evaluate(s.z, u));
        radius = evaluate(s.r, u);
        tangent = Vec3(slope(s.x, u), slope(s.y, u), slope(s.z, u));
        Real size = 0;
        for (int i = 0; i < 3; ++i)
            size +=
                std::abs(s.x[i + 1] - s.x[i]) + std::abs(s.y[i + 1] - s.y[i]) + std::abs(s.z[i + 1] - s.z[i]);
        const Real tiny = Real(1e-7) * size;
        speed = glm::length(tangent);
        regular = speed > tiny;
        if (!regular) {
            // C'' points along the curve where C' vanishes, backwards at u = 1.
            tangent = Vec3(curvature(s.x, u), curvature(s.y, u), curvature(s.z, u)) *
                      (u > Real(0.5) ? Real(-1) : Real(1));
            if (!(glm::length(tangent) > tiny))
                tangent = Vec3(s.x[3] - s.x[0], s.y[3] - s.y[0], s.z[3] - s.z[0]);
        }
        const Real length = glm::length(tangent);
        tangent = length > 0 ? tangent / length : Vec3(0);
    }
    /// Distance of the ray point at depth centre.z + s from the plane through the centre across the curve.
    Real off_plane(Real s) const { return s * tangent.z - centre.x * tangent.x - centre.y * tangent.y; }
    /// The s for which that distance is 0: infinite or NaN where the ray runs along the plane.
    Real plane_offset() const { return (centre.x * tangent.x + centre.y * tangent.y) / tangent.z; }
    /// From the centre to the ray point at depth centre.z + s.
    Vec3 arm(Real s) const { return Vec3(-centre.x, -centre.y, s); }
};

/// The flat discs across open strand ends, met from outside.
template <class Real>
void offer_flat_caps(const Swept<Real>& s, const PieceEnds& ends, Real z_min, SweptResult<Real>& result) {
    for (const int end : {0, 1}) {
        if (!(end == 0 ? ends.begins_strand : ends.ends_strand)) continue;
        const SweptPoint<Real> p(s, Real(end));
        const glm::vec<3, Real> outward = end == 0 ? -p.tangent : p.tangent;
        if (!(outward.z < 0) || !(p.radius > s.least_radius())) continue;
        const Real depth = (p.centre.x * p.tangent.x + p.centre.y * p.tangent.y) / p.tangent.z;
        const Real z = p.centre.z + depth;
        if (!(glm::length(p.arm(depth)) <= p.radius) || !(z >= z_min)) continue;
        result.offer({z, Real(end), p.radius, outward, true});
    }
}

/// Swept spheres. Along the ray, each interval of u with D >= 0 is one connected part of the solid: it is
/// entered at the least z - sqrt(D) and left at the greatest z + sqrt(D).
template <class Real>
SweptResult<Real> hit_spheres(const Swept<Real>& s, const PieceEnds& ends, Real z_min) {
    SweptResult<Real> result;
    const Real least_radius = s.least_radius();
    const std::optional<RoundCone<Real>> cone =
        ends.straight ? std::optional<RoundCone<Real>>(s) : std::nullopt;
    const Components<Real> components = cone ? cone->components() : find_components(s);
    for (const Interval<Real>& component : components) {
        Roots<Real> candidates =
            cone ? cone->stationary(component) : SurfaceRoots<Real>(s, component, 1).roots();
        for (const Real u : {component.a, component.b, component.a + (component.b - component.a) / 2})
            candidates.add(u);
        Real entry = std::numeric_limits<Real>::infinity(), exit = -entry, at = 0;
        for (const Real u : candidates) {
            const Real z = evaluate(s.z, u), chord = s.half_chord(u);
            exit = std::max(exit, z + chord);
            if (!(z - chord < entry)) continue;
            entry = z - chord;
            at = u;
        }
        if (!(entry <= exit)) continue;
        if (!(entry >= z_min)) {
            if (exit >= z_min) result.starts_inside = true;
            continue;
        }
        // Entered exactly at a tip of radius zero, which is no surface; no other point is the entry.
        if (!(evaluate(s.r, at) > least_radius)) continue;
        // A root of the exit that rounding has put just beside an end is that end, where the entry is not
        // stationary but cut off.
        constexpr Real at_end = 64 * std::numeric_limits<Real>::epsilon();
        if (at < at_end) at = 0;
        if (at > 1 - at_end) at = 1;
        const bool on_cap = (at == 0 && ends.begins_strand) || (at == 1 && ends.ends_strand);
        if (on_cap && ends.caps != Caps::round) continue;
        const SweptPoint<Real> p(s, at);
        result.offer({entry, at, p.radius, glm::normalize(p.arm(-s.half_chord(at))), on_cap});
    }
    if (ends.caps == Caps::flat) offer_flat_caps(s, ends, z_min, result);
    return result;
}

}  // namespace strandlab::oracle
