#include "unit/support/sampled_sweep.h"

#include "strands/bezier.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace strandlab::testing {
namespace {

using Wide = long double;
using Vec3 = glm::vec<3, Wide>;

Wide dot3(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The curve with the ray as z axis and the origin at the foot of its middle.
struct Sweep {
    CurveD c;  // x, y, z, radius in the frame
    Wide t_foot = 0, length = 1;
    Vec3 axis_x, axis_y, axis_z;

    Sweep(const Curve& curve, const Ray& ray, double radius_scale) {
        const Vec3 d(ray.direction), o(ray.origin);
        length = std::sqrt(dot3(d, d));
        axis_z = d / length;
        const Vec3 other = std::abs(axis_z.x) < 0.6L ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
        axis_x = other - axis_z * dot3(other, axis_z);
        axis_x /= std::sqrt(dot3(axis_x, axis_x));
        axis_y = Vec3(axis_z.y * axis_x.z - axis_z.z * axis_x.y, axis_z.z * axis_x.x - axis_z.x * axis_x.z,
                      axis_z.x * axis_x.y - axis_z.y * axis_x.x);
        t_foot = dot3(Vec3(curve[1]) - o, d) / dot3(d, d);
        for (int i = 0; i < 4; ++i) {
            const Vec3 p = (Vec3(curve[i]) - o) - d * t_foot;
            c[i] = glm::dvec4(double(dot3(p, axis_x)), double(dot3(p, axis_y)), double(dot3(p, axis_z)),
                              radius_scale * curve[i].w);
        }
    }

    /// D = r^2 - x^2 - y^2.
    double inside(double u) const {
        const glm::dvec4 p = point_at(c, u);
        const double distance = std::hypot(p.x, p.y);
        return p.w > 0 ? (p.w - distance) * (p.w + distance) : -distance * distance - 1e-300;
    }
    /// Depth of the entry into the ball at u; infinite where the line passes it.
    double entry(double u) const {
        const double d = inside(u);
        return d >= 0 ? point_at(c, u).z - std::sqrt(d) : std::numeric_limits<double>::infinity();
    }
};

/// Where f is least in [a, b], f with one minimum there.
template <class F>
double golden_section(F f, double a, double b) {
    const double ratio = 0.6180339887498949;
    double p = b - ratio * (b - a), q = a + ratio * (b - a), fp = f(p), fq = f(q);
    for (int i = 0; i < 70 && b - a > 1e-15; ++i) {
        if (fp <= fq) {
            b = q, q = p, fq = fp, p = b - ratio * (b - a), fp = f(p);
        } else {
            a = p, p = q, fp = fq, q = a + ratio * (b - a), fq = f(q);
        }
    }
    return fp <= fq ? p : q;
}

/// The point between inner (D >= 0) and outer (D < 0) where D changes its sign, on the inner side.
double boundary(const Sweep& sweep, double inner, double outer) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (inner + outer);
        (sweep.inside(middle) >= 0 ? inner : outer) = middle;
    }
    return inner;
}

struct Part {
    double a, b;
};

/// The connected parts of {D >= 0}.
std::vector<Part> parts_of(const Sweep& sweep) {
    constexpr int count = 600;
    std::vector<double> u(count + 1), d(count + 1);
    for (int i = 0; i <= count; ++i) u[i] = double(i) / count, d[i] = sweep.inside(u[i]);
    // Parts thinner than the spacing: peaks of D between samples.
    std::vector<double> extra;
    for (int i = 0; i <= count; ++i) {
        if (d[i] >= 0 || (i > 0 && d[i - 1] > d[i]) || (i < count && d[i + 1] > d[i])) continue;
        const double peak = golden_section([&](double v) { return -sweep.inside(v); }, u[std::max(i - 1, 0)],
                                           u[std::min(i + 1, count)]);
        if (sweep.inside(peak) >= 0) extra.push_back(peak);
    }
    std::vector<double> all(u);
    all.insert(all.end(), extra.begin(), extra.end());
    std::sort(all.begin(), all.end());
    std::vector<Part> parts;
    bool within = false;
    for (size_t i = 0; i < all.size(); ++i) {
        const bool now = sweep.inside(all[i]) >= 0;
        if (now && !within) parts.push_back({i == 0 ? 0 : boundary(sweep, all[i], all[i - 1]), 1});
        if (!now && within) parts.back().b = boundary(sweep, all[i - 1], all[i]);
        within = now;
    }
    return parts;
}

/// Parameter of the nearest entry within a part.
double nearest_entry(const Sweep& sweep, const Part& part) {
    constexpr int count = 64;
    const auto at = [&](int i) {  // denser towards the ends, where the entry depth is steep
        return part.a + (part.b - part.a) * 0.5 * (1 - std::cos(3.14159265358979323846 * i / count));
    };
    double best_u = part.a, best = sweep.entry(part.a);
    const auto consider = [&](double u) {
        const double z = sweep.entry(u);
        if (z < best) best = z, best_u = u;
    };
    for (int i = 0; i <= count; ++i) consider(at(i));
    for (int i = 0; i <= count; ++i) {
        const double here = sweep.entry(at(i));
        if (sweep.entry(at(std::max(i - 1, 0))) < here || sweep.entry(at(std::min(i + 1, count))) < here) continue;
        consider(golden_section([&](double u) { return sweep.entry(u); }, at(std::max(i - 1, 0)),
                                at(std::min(i + 1, count))));
    }
    return best_u;
}

}  // namespace

SweepHit sampled_sweep_hit(const Curve& curve, const Ray& ray, double radius_scale, bool open) {
    const Sweep sweep(curve, ray, radius_scale);
    const double z_min = double((Wide(ray.tmin) - sweep.t_foot) * sweep.length);
    SweepHit hit;
    double best = std::numeric_limits<double>::infinity();
    for (const Part& part : parts_of(sweep)) {
        const double u = nearest_entry(sweep, part), z = sweep.entry(u);
        if (!(z >= z_min)) {
            for (int i = 0; i <= 64; ++i) {
                const double v = part.a + (part.b - part.a) * i / 64;
                if (2 * point_at(sweep.c, v).z - sweep.entry(v) > z_min) hit.starts_inside = true;
            }
            continue;
        }
        if (open && (u <= 1e-9 || u >= 1 - 1e-9)) continue;
        if (!(z < best)) continue;
        best = z;
        const glm::dvec4 centre = point_at(sweep.c, u);
        hit.t = double(sweep.t_foot + Wide(z) / sweep.length);
        hit.u = u;
        hit.radius = centre.w;
        const glm::dvec3 n = glm::dvec3(-centre.x, -centre.y, z - centre.z) / centre.w;
        hit.normal = glm::dvec3(sweep.axis_x * Wide(n.x) + sweep.axis_y * Wide(n.y) + sweep.axis_z * Wide(n.z));
    }
    if (!(hit.t < ray.tmax)) hit.t = std::numeric_limits<double>::infinity();
    return hit;
}

}  // namespace strandlab::testing
