// Pieces and triangles of a surface with their radii scaled and their open ends moved.
#pragma once

#include "scene/surface.h"
#include "trace/oracle.h"
#include "trace/swept_hit.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace strandlab::oracle {

/// Distance between neighbouring floats of this size.
inline double float_ulp(double size) {
    return size > 0 ? std::ldexp(1.0, std::max(std::ilogb(size), -126) - 23) : 0;
}

/// A radius (>= 0) in the variation; size: largest coordinate of its piece relative to the first point.
inline double varied_radius(double radius, double size, const OracleOptions& options) {
    if (options.radius_scale == 1) return radius;
    const double least = options.radius_ulps * float_ulp(size);
    if (options.radius_scale > 1) return std::max(radius * options.radius_scale, radius + least);
    return std::max(0.0, std::min(radius * options.radius_scale, radius - least));
}

/// Largest coordinate of a piece relative to its first point.
inline double local_size(const SurfacePiece& piece) {
    double size = 0;
    for (const int i : {1, 2, 3}) {
        if (piece.straight && i < 3) continue;
        for (int axis = 0; axis < 3; ++axis)
            size = std::max(size, std::abs(double(piece.control[i][axis]) - double(piece.control[0][axis])));
    }
    return size;
}

/// The four varied radii of a piece; linear between the ends of a straight piece.
inline std::array<double, 4> varied_radii(const SurfacePiece& piece, const OracleOptions& options) {
    const double size = options.radius_scale == 1 ? 0 : local_size(piece);
    std::array<double, 4> r{};
    for (int i = 0; i < 4; ++i)
        r[i] = varied_radius(std::max(0.0, double(piece.control[i].w)), size, options);
    if (piece.straight) {
        r[1] = (2 * r[0] + r[3]) / 3;
        r[2] = (r[0] + 2 * r[3]) / 3;
    }
    return r;
}

/// How far the parameter interval of a piece reaches: [0, 1], more or less at strand ends that are moved.
struct ParameterRange {
    double a = 0, b = 1;

    ParameterRange(const SurfacePiece& piece, Caps caps, const OracleOptions& options) {
        if (caps == Caps::round) return;
        if (piece.begins_strand) a -= options.end_shift;
        if (piece.ends_strand) b += options.end_shift;
    }
    double local(double u) const { return std::clamp((u - a) / (b - a), 0.0, 1.0); }
    double global(double u) const { return a + (b - a) * u; }
};

/// A piece in the frame of a ray, on its parameter range.
template <class Real>
Swept<Real> swept_piece(const Frame<Real>& frame, const SurfacePiece& piece, const ParameterRange& range,
                        const OracleOptions& options) {
    Swept<Real> s;
    const std::array<double, 4> radii = varied_radii(piece, options);
    for (int i = 0; i < 4; ++i) {
        if (piece.straight && (i == 1 || i == 2)) continue;
        const glm::vec<3, Real> p = frame.local(glm::dvec3(piece.control[i]));
        s.x[i] = p.x;
        s.y[i] = p.y;
        s.z[i] = p.z;
        s.r[i] = Real(radii[i]);
    }
    if (piece.straight)
        for (Cubic<Real>* c : {&s.x, &s.y, &s.z, &s.r}) {
            (*c)[1] = (2 * (*c)[0] + (*c)[3]) / 3;
            (*c)[2] = ((*c)[0] + 2 * (*c)[3]) / 3;
        }
    return s.on(Real(range.a), Real(range.b));
}

/// The vertices of a triangle, moved along their offsets from the centre line.
inline std::array<glm::dvec3, 3> varied_vertices(const SurfaceTriangle& triangle,
                                                 const OracleOptions& options) {
    std::array<glm::dvec3, 3> vertices;
    double size = 0;
    for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            size =
                std::max(size, std::abs(double(triangle.vertex[i][axis]) - double(triangle.vertex[0][axis])));
    for (int i = 0; i < 3; ++i) {
        vertices[i] = glm::dvec3(triangle.vertex[i]);
        const glm::dvec3 centre(triangle.centre[i]), offset = vertices[i] - centre;
        const double radius = glm::length(offset);
        if (options.radius_scale != 1 && radius > 0)
            vertices[i] = centre + offset * (varied_radius(radius, size, options) / radius);
    }
    return vertices;
}

}  // namespace strandlab::oracle
