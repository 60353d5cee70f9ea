// First front-facing hit of a ray with discs swept along a curve.
#pragma once

#include "trace/swept_hit.h"

namespace strandlab::oracle {

/// Whether the point at depth z of the ray lies in one of the discs: (p - C) . C' = 0 has a root (degree 5)
/// with |p - C| <= r, or p lies in the half ball of a round end.
template <class Real>
bool discs_contain(const Swept<Real>& s, const PieceEnds& ends, Real z) {
    Swept<Real> at = s;
    for (Real& c : at.z) c -= z;
    const auto excess = [&](Real u) {
        const Real x = evaluate(at.x, u), y = evaluate(at.y, u), w = evaluate(at.z, u);
        return evaluate(at.r, u) - std::sqrt(x * x + y * y + w * w);
    };
    if (ends.caps == Caps::round)
        for (const int end : {0, 1}) {
            if (!(end == 0 ? ends.begins_strand : ends.ends_strand)) continue;
            const SweptPoint<Real> p(at, Real(end));
            const Real beyond =
                -p.centre.x * p.tangent.x - p.centre.y * p.tangent.y - p.centre.z * p.tangent.z;
            if (excess(Real(end)) >= 0 && (end == 0 ? beyond <= 0 : beyond >= 0)) return true;
        }
    constexpr int max_depth = 40;
    std::array<SweptPart<Real>, max_depth + 2> stack;
    int size = 0;
    stack[size++] = {at, 0, 1, 0};
    for (int parts = 0; size > 0; ++parts) {
        const SweptPart<Real> part = stack[--size];
        Scaled<Real, 6> ball = inside_coefficients(part.s.x, part.s.y, part.s.r);
        add_product<Real, 3, 3>(ball, scaled(part.s.z), scaled(part.s.z), Real(-1));
        if (*std::max_element(ball.begin(), ball.end()) < 0) continue;
        Scaled<Real, 5> along{};
        add_product<Real, 3, 2>(along, scaled(part.s.x), scaled_slope(part.s.x), Real(1));
        add_product<Real, 3, 2>(along, scaled(part.s.y), scaled_slope(part.s.y), Real(1));
        add_product<Real, 3, 2>(along, scaled(part.s.z), scaled_slope(part.s.z), Real(1));
        if (along.front() == 0 && excess(part.a) >= 0 && SweptPoint<Real>(at, part.a).regular) return true;
        if (along.back() == 0 && excess(part.b) >= 0 && SweptPoint<Real>(at, part.b).regular) return true;
        const int variations = sign_variations(along);
        if (variations == 0) continue;
        if (variations == 1) {
            const auto f = [&](Real u) {
                return evaluate(at.x, u) * slope(at.x, u) + evaluate(at.y, u) * slope(at.y, u) +
                       evaluate(at.z, u) * slope(at.z, u);
            };
            if (excess(bracketed_root(f, part.a, part.b, leading_sign(along))) >= 0) return true;
            continue;
        }
        if (part.depth >= max_depth || parts > most_subdivisions || !part.can_be_split()) {
            if (excess(part.middle()) >= 0) return true;
            continue;
        }
        part.split_into(stack[size + 1], stack[size]);
        size += 2;
    }
    return false;
}

/// Outward normal of the swept discs at p = C + arm: the cross product of the derivatives along and
/// around the tube, (|C'| - r e . T_u) e - r' T with e = arm / r and T_u = (C'' - T (T . C'')) / |C'|.
template <class Real>
glm::vec<3, Real> disc_normal(const Swept<Real>& s, const SweptPoint<Real>& p, Real u,
                              const glm::vec<3, Real>& arm) {
    using Vec3 = glm::vec<3, Real>;
    const Vec3 e = glm::normalize(arm);
    if (!p.regular) return e;
    const Vec3 second(curvature(s.x, u), curvature(s.y, u), curvature(s.z, u));
    const Vec3 turn = (second - p.tangent * glm::dot(p.tangent, second)) / p.speed;
    const Real dr = slope(s.r, u);
    const Vec3 normal = (p.speed - p.radius * glm::dot(e, turn)) * e - dr * p.tangent;
    const Vec3 cone = e - (dr / p.speed) * p.tangent;
    const Real length = glm::length(normal);
    if (!(length > 0)) return glm::normalize(cone);
    return glm::dot(normal, cone) < 0 ? -normal / length : normal / length;
}

/// Offers the point at parameter u and depth centre.z + offset if it is on the surface and faces the ray.
/// Facing is that of the tangent cone, e - (r' / |C'|) T, whose sign does not flip on inner sheets.
template <class Real>
void offer_disc_point(const Swept<Real>& s, Real u, Real offset, Real z_min, SweptResult<Real>& result) {
    const SweptPoint<Real> p(s, u);
    if (!(p.radius > s.least_radius())) return;
    // H vanishes with C' whatever the ray, and near such a root its sign is rounding noise; the tangent, at
    // the root its limit, tells whether the point is real.
    const bool has_plane = glm::length(p.tangent) > 0;
    if (!has_plane || !(std::abs(p.off_plane(offset)) <= Real(1e-6) * p.radius)) return;
    const Real slant = p.regular ? slope(s.r, u) / p.speed * p.tangent.z : Real(0);
    if (!(offset / p.radius - slant < 0)) return;
    const Real z = p.centre.z + offset;
    if (!(z >= z_min)) return;
    result.offer({z, u, p.radius, disc_normal(s, p, u, p.arm(offset)), false});
}

/// Half balls at strand ends, on the far side of the end planes.
template <class Real>
void offer_round_ends(const Swept<Real>& s, const PieceEnds& ends, Real z_min, SweptResult<Real>& result) {
    for (const int end : {0, 1}) {
        if (!(end == 0 ? ends.begins_strand : ends.ends_strand)) continue;
        const SweptPoint<Real> p(s, Real(end));
        if (!(s.inside(Real(end)) >= 0) || !(p.radius > s.least_radius())) continue;
        const Real offset = -s.half_chord(Real(end)), beyond = p.off_plane(offset), z = p.centre.z + offset;
        if (!(end == 0 ? beyond <= 0 : beyond >= 0) || !(z >= z_min)) continue;
        result.offer({z, Real(end), p.radius, glm::normalize(p.arm(offset)), true});
    }
}

/// Where D vanishes and the ray runs along the curve, both factors of H = z'^2 D - w^2 vanish together and
/// H does not tell: the ray meets the disc at its rim, in the point s = w / z' from the foot (D = s^2).
/// Exactly parallel to a straight tapering tube, that is the only root.
template <class Real>
void offer_rim(const Swept<Real>& s, Real u, Real z_min, SweptResult<Real>& result) {
    const SweptPoint<Real> p(s, u);
    const bool is_root = u > 0 && u < 1;  // of D; the ends of the curve may lie anywhere within the tube
    if (!is_root && !(s.half_chord(u) <= Real(1e-7) * p.radius)) return;
    // Beyond this, w^2 is not lost in the rounding of D, and isolation finds the root.
    const Real offset = p.plane_offset();
    if (std::abs(offset) <= Real(1e-7) * p.radius) offer_disc_point(s, u, offset, z_min, result);
}

/// Swept discs, open unless caps says otherwise.
template <class Real>
SweptResult<Real> hit_discs(const Swept<Real>& s, const PieceEnds& ends, Real z_min) {
    SweptResult<Real> result;
    for (const Interval<Real>& component : find_components(s)) {
        const SurfaceRoots<Real> isolated(s, component, 0);
        for (const Real u : isolated.roots()) {
            // Close to the rim sqrt(D) is rounding noise, and the plane of the disc is not, unless the ray
            // lies in it.
            const SweptPoint<Real> p(s, u);
            const Real rim = Real(1e-3) * p.radius;
            if (std::abs(p.tangent.z) > Real(0.5) && s.half_chord(u) <= rim) {
                if (std::abs(p.plane_offset()) <= 2 * rim)
                    offer_disc_point(s, u, p.plane_offset(), z_min, result);
                continue;
            }
            // H is the product of the residuals of entry and exit; where both vanish the ray crosses the
            // curve at a right angle and both points count.
            const Real chord = s.half_chord(u), h = s.drift(u, 0), dz = slope(s.z, u);
            const Real entry = std::abs(h + dz * chord), exit = std::abs(h - dz * chord);
            const Real both = Real(1e-9) * std::max(p.speed * p.radius, std::abs(h));
            if (entry <= exit || entry <= both) offer_disc_point(s, u, -chord, z_min, result);
            if (exit <= entry || exit <= both) offer_disc_point(s, u, chord, z_min, result);
        }
        offer_rim(s, component.a, z_min, result);
        if (component.b > component.a) offer_rim(s, component.b, z_min, result);
    }
    if (ends.caps == Caps::round) offer_round_ends(s, ends, z_min, result);
    if (ends.caps == Caps::flat) offer_flat_caps(s, ends, z_min, result);
    result.starts_inside = discs_contain(s, ends, z_min);
    return result;
}

}  // namespace strandlab::oracle
