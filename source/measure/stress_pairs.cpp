// How the strands and rays of the families are drawn.
#include "measure/stress_families.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace strandlab {
namespace {

using Family = StressFamily;
using Points = std::array<glm::dvec3, 4>;

constexpr double pi = 3.14159265358979323846;

double log_uniform(Random& random, double low, double high) {
    return low < high ? low * std::pow(high / low, random.uniform()) : low;
}

glm::dvec3 random_direction(Random& random) {
    while (true) {
        const double x = random.signed_unit(), y = random.signed_unit(), z = random.signed_unit();
        const glm::dvec3 v(x, y, z);
        const double size = glm::length(v);
        if (size > 0.1 && size < 1) return v / size;
    }
}

glm::dvec3 any_perpendicular(const glm::dvec3& v) {
    const glm::dvec3 other = std::abs(v.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(v, other));
}

/// v turned by an angle about a unit axis (Rodrigues).
glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

/// Three edges that turn by half the angle at each corner, about axes up to 45 degrees apart.
Points smooth_points(const Family& family, Random& random) {
    const double turn = random.range(family.turn_low, family.turn_high) * pi / 180;
    glm::dvec3 edge = random_direction(random);
    glm::dvec3 axis = turned(any_perpendicular(edge), edge, random.range(0, 2 * pi));
    Points points;
    points[0] = 0.5 * random_direction(random);
    for (int i = 0; i < 3; ++i) {
        points[i + 1] = points[i] + edge * (random.range(0.7, 1.3) / 3);
        edge = turned(edge, axis, turn / 2);
        axis = turned(axis, edge, random.range(-pi / 4, pi / 4));
    }
    return points;
}

/// Zero tangents at one or both ends, folds and cusps on a line, closed loops, repeated inner points.
void make_degenerate(Points& p, Random& random) {
    const glm::dvec3 chord = p[3] - p[0];
    switch (random.below(6)) {
        case 0: p[1] = p[0]; break;
        case 1: p[2] = p[3]; break;
        case 2: p[1] = p[0], p[2] = p[3]; break;
        case 3: p[2] = p[1]; break;
        case 4:
            p[1] = p[0] + chord * random.range(-0.5, 1.5), p[2] = p[0] + chord * random.range(-0.5, 1.5);
            break;
        default: p[3] = p[0]; break;
    }
}

/// A control polygon in the shape of a bow: a cusp at u = 1/2 where its arms cross at the inner points'
/// distance, a loop where they reach further.
void make_cusp(Points& p, Random& random) {
    const glm::dvec3 x = random_direction(random);
    const glm::dvec3 y = turned(any_perpendicular(x), x, random.range(0, 2 * pi));
    const double reach = random.below(2) == 0 ? 0 : random.range(0, 0.5);
    const double width = 0.5, height = random.range(0.3, 0.7);
    p[1] = p[0] + width * (1 + reach) * x + height * y;
    p[2] = p[0] - width * reach * x + height * y;
    p[3] = p[0] + width * x;
}

Points make_points(const Family& family, Random& random) {
    Points points = smooth_points(family, random);
    switch (family.shape) {
        case Family::Shape::smooth: break;
        case Family::Shape::degenerate: make_degenerate(points, random); break;
        case Family::Shape::cusp: make_cusp(points, random); break;
        case Family::Shape::point: points.fill(points[0]); break;
        case Family::Shape::nested: {
            const double size = random.range(0.02, 0.3);
            for (int i = 1; i < 4; ++i) points[i] = points[0] + size * (points[i] - points[0]);
            break;
        }
    }
    return points;
}

/// Moves and turns a curve so that it continues another, with a kink of at most that angle.
Points continued(const Points& before, const Points& next, double kink, Random& random) {
    const glm::dvec3 from = glm::normalize(next[1] - next[0]);
    glm::dvec3 to = glm::normalize(before[3] - before[2]);
    if (kink > 0) {
        const glm::dvec3 about = turned(any_perpendicular(to), to, random.range(0, 2 * pi));
        to = turned(to, about, random.range(0, kink) * pi / 180);
    }
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal);
    const glm::dvec3 axis = sine > 1e-9 ? normal / sine : any_perpendicular(from);
    const double angle = std::atan2(sine, glm::dot(from, to));
    Points points;
    for (int i = 0; i < 4; ++i) points[i] = before[3] + turned(next[i] - next[0], axis, angle);
    return points;
}

std::vector<Curve> draw_strand(const Family& family, Random& random) {
    Points points = make_points(family, random);
    const double root = log_uniform(random, family.radius_low, family.radius_high);
    const double tip = root * random.range(family.taper_low, family.taper_high);
    const glm::dvec3 offset = family.offset > 0 ? family.offset * random_direction(random) : glm::dvec3(0);
    std::vector<Curve> strand;
    for (uint32_t k = 0; k < family.curves; ++k) {
        if (k > 0) points = continued(points, make_points(family, random), family.kink, random);
        CurveD curve;
        for (int i = 0; i < 4; ++i) {
            const double along = (3 * k + static_cast<uint32_t>(i)) / (3.0 * family.curves);
            curve[i] = family.unit * glm::dvec4(points[i] + offset, root + (tip - root) * along);
        }
        strand.push_back(to_float(curve));
        if (k > 0) strand[k][0] = strand[k - 1][3];
    }
    return strand;
}

glm::dvec3 draw_direction(const Family& family, const glm::dvec3& tangent, Random& random) {
    if (family.axis_aligned) {
        static const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, -1}, {1, 1, 1}};
        return axes[random.below(6)] * (random.below(2) == 0 ? 1.0 : -1.0);
    }
    if (!(family.tilt_high > 0) || tangent == glm::dvec3(0)) return random_direction(random);
    const double tilt = log_uniform(random, family.tilt_low, family.tilt_high);
    const glm::dvec3 axis = turned(any_perpendicular(tangent), tangent, random.range(0, 2 * pi));
    return turned(tangent, axis, tilt) * (random.below(2) == 0 ? 1.0 : -1.0);
}

double draw_length(const Family& family, Random& random) {
    if (family.axis_aligned) return std::exp2(int(random.below(5)) - 2);
    if (family.length_high > 100 * family.length_low)
        return log_uniform(random, family.length_low, family.length_high);
    return random.range(family.length_low, family.length_high);
}

/// Where on a target to aim: anywhere, or within three radii of an end.
double draw_place(const Family& family, const CurveD& axis, bool at_start, Random& random) {
    const double u = random.uniform();
    if (!family.at_joints) return u;
    const double length = glm::length(glm::dvec3(axis[3] - axis[0]));
    const double near = std::min(1.0, 3 * axis[at_start ? 0 : 3].w / std::max(length, 1e-300)) * u;
    return at_start ? near : 1 - near;
}

/// The ray of an instance's object space as a driver computes it: from a ray of the world, in float.
Ray through_instance(const Family& family, const glm::dvec3& origin, const glm::dvec3& direction,
                     Random& random) {
    const glm::dvec3 x = random_direction(random);
    const glm::dvec3 y = turned(any_perpendicular(x), x, random.range(0, 2 * pi));
    glm::dmat3 rotation(x, y, glm::cross(x, y)), stretch(1.0);
    for (int i = 0; i < 3; ++i) stretch[i][i] = log_uniform(random, 0.1, 10);
    if (family.instance == Family::Instance::mirrored) stretch[0][0] = -stretch[0][0];
    const glm::dvec3 turn_x = random_direction(random);
    const glm::dmat3 turn(turn_x, any_perpendicular(turn_x), glm::cross(turn_x, any_perpendicular(turn_x)));
    const glm::mat3 matrix(turn * stretch * glm::transpose(rotation));
    const glm::vec3 place(3.0 * random_direction(random));
    const glm::dmat3 exact(matrix);
    const glm::vec3 world_origin(exact * origin + glm::dvec3(place)), world_direction(exact * direction);
    const glm::mat3 inverse = glm::inverse(matrix);
    Ray ray;
    ray.origin = inverse * (world_origin - place);
    ray.direction = inverse * world_direction;
    return ray;
}

/// Moves tmin or tmax to within two radii before and one radius behind the axis.
void shorten(Ray& ray, double distance, double radius, Random& random) {
    const double size = glm::length(glm::dvec3(ray.direction));
    const auto t = static_cast<float>(std::max(0.0, (distance + random.range(-2, 1) * radius) / size));
    (random.below(2) == 0 ? ray.tmin : ray.tmax) = t;
}

/// The direction from a place within the strand to within a radius and a half of any other place of it.
glm::dvec3 towards_another_part(std::span<const StressTarget> targets, const glm::dvec3& origin,
                                const glm::dvec3& otherwise, Random& random) {
    const StressTarget& target = targets[random.below(static_cast<uint32_t>(targets.size()))];
    const glm::dvec4 point = point_at(target.axis, random.uniform());
    const glm::dvec3 aim = glm::dvec3(point) + random_direction(random) * (1.5 * point.w * random.uniform());
    return glm::length(aim - origin) > 2 * point.w ? glm::normalize(aim - origin) : otherwise;
}

Ray draw_ray(const Family& family, std::span<const StressTarget> targets, Random& random) {
    assert(!targets.empty());
    const auto count = static_cast<uint32_t>(targets.size());
    const uint32_t chosen = count > 1 ? random.below(count) : 0;
    const StressTarget& target = targets[chosen];
    // Of the inner joints, those of the neighbours.
    const bool at_start = family.at_joints && (chosen + 1 == count || (chosen > 0 && random.below(2) == 0));
    const double u = draw_place(family, target.axis, at_start, random);
    const glm::dvec4 point = point_at(target.axis, u);
    const glm::dvec3 tangent = tangent_at(target.axis, u);
    glm::dvec3 direction = draw_direction(family, tangent, random);
    glm::dvec3 aside = target.width != glm::dvec3(0) ? target.width : glm::cross(direction, tangent);
    aside = glm::length(aside) > 1e-9 ? glm::normalize(aside) : any_perpendicular(direction);
    double lateral = random.range(family.lateral_low, family.lateral_high) * point.w;
    if (family.inside) lateral *= 0.7;
    if (random.below(2) == 0) lateral = -lateral;
    const double distance =
        family.inside ? random.range(0, 0.5) * point.w
                      : family.unit * log_uniform(random, family.distance_low, family.distance_high);
    const glm::dvec3 aim = glm::dvec3(point) + aside * lateral;
    glm::dvec3 origin = aim - direction * distance;
    if (family.returns) direction = towards_another_part(targets, origin, direction, random);
    // Far from the world's origin the ray's own origin is rounded by more than a radius: aim from there.
    if (family.offset > 0 && family.offset != 1e4) {
        origin = glm::dvec3(glm::vec3(origin));
        direction = glm::length(aim - origin) > 0 ? glm::normalize(aim - origin) : direction;
    }
    direction *= draw_length(family, random);
    Ray ray;
    if (family.instance != Family::Instance::none) {
        ray = through_instance(family, origin, direction, random);
    } else {
        ray.origin = glm::vec3(origin);
        ray.direction = glm::vec3(direction);
    }
    if (family.short_ray) shorten(ray, distance, point.w, random);
    return ray;
}

/// The same generator for strand and ray: the ray's draws come after the strand's.
Random generator_of(const Family& family, uint64_t seed, uint64_t index) {
    uint64_t stream = 0;
    for (const char c : family.name) stream = mix_bits(stream + static_cast<unsigned char>(c));
    return Random(seed, stream, index);
}

const StressPair& lattice_pair(uint64_t index) {
    const auto pairs = structured_pairs();
    return pairs[index % pairs.size()];
}

}  // namespace

std::vector<Curve> make_strand(const StressFamily& family, uint64_t seed, uint64_t index) {
    if (family.lattice) return lattice_pair(index).strand;
    Random random = generator_of(family, seed, index);
    return draw_strand(family, random);
}

Ray make_ray(const StressFamily& family, uint64_t seed, uint64_t index,
             std::span<const StressTarget> targets) {
    if (family.lattice) return lattice_pair(index).ray;
    Random random = generator_of(family, seed, index);
    const std::vector<Curve> strand = draw_strand(family, random);
    if (!targets.empty()) return draw_ray(family, targets, random);
    std::vector<StressTarget> own;
    for (const Curve& curve : strand) own.push_back({to_double(curve), glm::dvec3(0)});
    return draw_ray(family, own, random);
}

StressPair make_pair(const StressFamily& family, uint64_t index, uint64_t seed) {
    return {make_strand(family, seed, index), make_ray(family, seed, index)};
}

}  // namespace strandlab
