#include "unit/support/disc_reference.h"

#include <cmath>
#include <functional>
#include <vector>

namespace strandlab::testing {
namespace {

/// The tube in the frame of the ray: z along the ray, origin at the ray's point nearest to the curve.
struct Tube {
    CurveD curve;

    double inside(double u) const {
        const glm::dvec4 c = point_at(curve, u);
        const double distance = std::hypot(c.x, c.y);
        return (c.w - distance) * (c.w + distance);
    }
    /// Half the derivative of inside().
    double slope(double u) const {
        const glm::dvec4 c = point_at(curve, u), d = derivative_at(curve, u);
        return c.w * d.w - c.x * d.x - c.y * d.y;
    }
    /// Distance of the ray's point at depth C.z + side sqrt(inside) from the plane of the disc, times |C'|.
    double off_plane(double u, double side) const {
        const glm::dvec4 c = point_at(curve, u), d = derivative_at(curve, u);
        const double s = side * std::sqrt(std::max(inside(u), 0.0));
        return s * d.z - c.x * d.x - c.y * d.y;
    }
};

/// A root of f in [low, high], given a change of sign.
template <class F>
double bisect(F&& f, double low, double high) {
    const bool rises = f(low) < 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((f(middle) < 0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

struct Interval {
    double low, high;
};

/// Where the ray's line is within r of the curve.
std::vector<Interval> pierced(const Tube& tube, double a, double b) {
    constexpr int samples = 160;
    std::vector<double> points;
    for (int i = 0; i <= samples; ++i) {
        const double u = a + (b - a) * i / samples;
        if (i > 0) {
            const double before = points.back();
            if (tube.slope(before) > 0 && tube.slope(u) < 0)
                points.push_back(bisect([&](double x) { return tube.slope(x); }, before, u));
        }
        points.push_back(u);
    }
    std::vector<Interval> intervals;
    const auto inside = [&](double u) { return tube.inside(u); };
    bool open = false;
    for (size_t i = 0; i < points.size(); ++i) {
        const bool in = inside(points[i]) >= 0;
        if (in && !open) intervals.push_back({i == 0 ? a : bisect(inside, points[i - 1], points[i]), b});
        if (!in && open) intervals.back().high = bisect(inside, points[i - 1], points[i]);
        open = in;
    }
    return intervals;
}

void add_roots(const Tube& tube, const Interval& interval, double side,
               const std::function<void(double)>& found) {
    constexpr int samples = 64;
    const auto f = [&](double u) { return tube.off_plane(u, side); };
    double before = interval.low, value_before = f(before);
    for (int i = 1; i <= samples; ++i) {
        // Dense towards the ends, where the square root is steep.
        const double u = interval.low + (interval.high - interval.low) * 0.5 *
                                            (1 - std::cos(3.14159265358979323846 * i / samples));
        const double value = f(u);
        if ((value < 0) != (value_before < 0)) found(bisect(f, before, u));
        before = u;
        value_before = value;
    }
}

}  // namespace

std::optional<DiscHit> first_disc_hit(const CurveD& curve, const Ray& ray, double scale, double a, double b) {
    const glm::dvec3 origin(ray.origin), direction(ray.direction);
    const double size = glm::length(direction);
    const glm::dvec3 n = direction / size;
    const glm::dvec3 x =
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(n, x);
    const glm::dvec3 middle = 0.25 * glm::dvec3(curve[0] + curve[1] + curve[2] + curve[3]);
    const double t_foot = glm::dot(middle - origin, direction) / (size * size);
    const glm::dvec3 foot = origin + t_foot * direction;
    Tube tube;
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 p = glm::dvec3(curve[i]) - foot;
        tube.curve[i] = {glm::dot(p, x), glm::dot(p, y), glm::dot(p, n), scale * curve[i].w};
    }
    std::optional<DiscHit> best;
    for (const Interval& interval : pierced(tube, a, b))
        for (const double side : {-1.0, 1.0})
            add_roots(tube, interval, side, [&](double u) {
                const glm::dvec4 c = point_at(tube.curve, u), d = derivative_at(tube.curve, u);
                const glm::dvec4 second = second_derivative_at(tube.curve, u);
                const double speed = glm::length(glm::dvec3(d));
                if (!(speed > 0 && c.w > 0)) return;
                const double s = side * std::sqrt(std::max(tube.inside(u), 0.0));
                const glm::dvec3 e = glm::dvec3(-c.x, -c.y, s) / c.w, tangent = glm::dvec3(d) / speed;
                if (!((e - tangent * (d.w / speed)).z < 0)) return;
                const double t = t_foot + (c.z + s) / size;
                if (!(t >= ray.tmin && t <= ray.tmax) || (best && best->t <= t)) return;
                const double shrink = 1 - c.w * glm::dot(e, glm::dvec3(second)) / (speed * speed);
                const glm::dvec3 normal = glm::normalize(e * shrink - tangent * (d.w / speed));
                best = DiscHit{t, u, c.w, x * normal.x + y * normal.y + n * normal.z};
            });
    return best;
}

DiscAnswer disc_answer(const CurveD& curve, const Ray& ray) {
    constexpr double margin = 1e-3;
    DiscAnswer answer;
    answer.hit = first_disc_hit(curve, ray);
    const auto larger = first_disc_hit(curve, ray, 1 + margin, -margin, 1 + margin);
    const auto smaller = first_disc_hit(curve, ray, 1 - margin, margin, 1 - margin);
    const auto agrees = [&](const std::optional<DiscHit>& other) {
        if (other.has_value() != answer.hit.has_value()) return false;
        return !other || std::abs(other->t - answer.hit->t) * glm::length(glm::dvec3(ray.direction)) <
                             0.3 * answer.hit->radius;
    };
    answer.decisive = agrees(larger) && agrees(smaller);
    return answer;
}

}  // namespace strandlab::testing
