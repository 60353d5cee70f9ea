// The ray frame of the reference: a primitive seen with the ray as z axis, to the last bit of the scalar
// type relative to the size of the primitive, however far away the ray starts.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace strandlab::oracle {

/// A ray in double precision (an instance's transform may have made it). tmin <= t <= tmax.
struct ExactRay {
    glm::dvec3 origin, direction;
    double tmin = 0, tmax = 0;
};

/// The upper 26 bits of a double, so that products with 27-bit numbers are exact (Dekker 1971).
inline double upper_half(double x) {
    const double c = 134217729.0 * x;  // 2^27 + 1
    return c - (c - x);
}

/// Frame around one primitive: origin at the point of the ray nearest to the primitive's middle, axes
/// (axis_x, axis_y, direction / |direction|).
template <class Real>
struct Frame {
    using Vec3 = glm::vec<3, Real>;

    glm::dvec3 reference;  // a point of the primitive
    Vec3 foot;             // from the reference to the frame's origin
    Vec3 axis_x, axis_y, axis_z;
    Real t_foot, length;  // ray parameter of the origin; |direction|

    Frame(const ExactRay& ray, const glm::dvec3& reference_point, const glm::dvec3& middle)
        : reference(reference_point) {
        const Vec3 d(ray.direction);
        const Real length_squared = dot(d, d);
        length = std::sqrt(length_squared);
        // Any parameter near the foot point will do, so take one with few bits: then t * d is exact as the
        // sum of two doubles, and the frame's origin is known as an unevaluated sum.
        const double t =
            upper_half(glm::dot(middle - ray.origin, ray.direction) / glm::dot(ray.direction, ray.direction));
        t_foot = t;
        for (int i = 0; i < 3; ++i) {
            const double d_high = upper_half(ray.direction[i]), d_low = ray.direction[i] - d_high;
            foot[i] = sum4(ray.origin[i], -reference[i], t * d_high, t * d_low);
        }
        // Orthonormal basis with one branch (Duff et al. 2017).
        const Vec3 n = d / length;
        const Real side = std::copysign(Real(1), n.z), a = Real(-1) / (side + n.z), b = n.x * n.y * a;
        axis_x = Vec3(1 + side * n.x * n.x * a, side * b, -side * n.x);
        axis_y = Vec3(b, side + n.y * n.y * a, -n.y);
        axis_z = n;
    }

    /// A point in the frame.
    Vec3 local(const glm::dvec3& point) const {
        const Vec3 p = (Vec3(point) - Vec3(reference)) - foot;
        return Vec3(dot(p, axis_x), dot(p, axis_y), dot(p, axis_z));
    }
    /// A vector of the frame in the space of the ray.
    glm::dvec3 global(Real x, Real y, Real z) const {
        return glm::dvec3(axis_x * x + axis_y * y + axis_z * z);
    }
    /// Ray parameter of a depth, and back.
    Real parameter(Real z) const { return t_foot + z / length; }
    Real depth(double t) const { return (Real(t) - t_foot) * length; }

  private:
    static Real dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

    /// sum = fl(a + b) and its exact residue (Knuth's two-sum).
    static double two_sum(double a, double b, double& residue) {
        const double sum = a + b, bb = sum - a;
        residue = (a - (sum - bb)) + (b - bb);
        return sum;
    }

    /// a + b + c + d with the rounding errors of three additions put back: exact to the last bit of Real
    /// up to terms of 2^-106 of the largest addend.
    static Real sum4(double a, double b, double c, double d) {
        double e1, e2, e3;
        const double s1 = two_sum(a, b, e1);
        const double s2 = two_sum(s1, c, e2);
        const double s3 = two_sum(s2, d, e3);
        return Real(s3) + (Real(e2) + (Real(e1) + Real(e3)));
    }
};

}  // namespace strandlab::oracle
