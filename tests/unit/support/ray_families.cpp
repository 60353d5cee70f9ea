#include "unit/support/ray_families.h"

#include "strands/bezier.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strandlab::testing {
namespace {

constexpr double pi = 3.14159265358979323846;

double log_uniform(Random& random, double low, double high) {
    return low < high ? low * std::pow(high / low, random.uniform()) : low;
}

glm::dvec3 random_direction(Random& random) {
    while (true) {
        const glm::dvec3 v(random.signed_unit(), random.signed_unit(), random.signed_unit());
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

using Points = std::array<glm::dvec3, 4>;

/// Three edges that turn by half the angle at each corner, about axes up to 45 degrees apart.
Points smooth_points(const RayFamily& family, Random& random) {
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
Points degenerate_points(const RayFamily& family, Random& random) {
    Points p = smooth_points(family, random);
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
    return p;
}

CurveD make_curve(const RayFamily& family, Random& random) {
    const Points points = family.shape == RayFamily::Shape::degenerate ? degenerate_points(family, random)
                                                                       : smooth_points(family, random);
    const double root = log_uniform(random, family.radius_low, family.radius_high);
    const double tip = root * random.range(family.taper_low, family.taper_high);
    CurveD curve;
    const glm::dvec3 offset = family.offset > 0 ? family.offset * random_direction(random) : glm::dvec3(0);
    for (int i = 0; i < 4; ++i) curve[i] = glm::dvec4(points[i] + offset, root + (tip - root) * i / 3.0);
    return to_double(to_float(curve));
}

glm::dvec3 make_direction(const RayFamily& family, const glm::dvec3& tangent, Random& random) {
    if (!(family.tilt_high > 0) || tangent == glm::dvec3(0)) return random_direction(random);
    const double tilt = log_uniform(random, family.tilt_low, family.tilt_high);
    const glm::dvec3 axis = turned(any_perpendicular(tangent), tangent, random.range(0, 2 * pi));
    return turned(tangent, axis, tilt) * (random.below(2) == 0 ? 1.0 : -1.0);
}

Ray make_ray(const RayFamily& family, const CurveD& curve, Random& random) {
    const double u = random.uniform();
    const glm::dvec4 point = point_at(curve, u);
    const glm::dvec3 tangent = tangent_at(curve, u);
    const glm::dvec3 direction = make_direction(family, tangent, random);
    glm::dvec3 aside = glm::cross(direction, tangent);
    aside = glm::length(aside) > 1e-9 ? glm::normalize(aside) : any_perpendicular(direction);
    double lateral = random.range(family.lateral_low, family.lateral_high) * point.w;
    if (family.inside) lateral *= 0.7;
    if (random.below(2) == 0) lateral = -lateral;
    const double distance = family.inside ? random.range(0, 0.5) * point.w
                                          : log_uniform(random, family.distance_low, family.distance_high);
    Ray ray;
    ray.origin = glm::vec3(glm::dvec3(point) + aside * lateral - direction * distance);
    ray.direction = glm::vec3(direction * random.range(0.5, 2.0));
    return ray;
}

void add_lattice(const Curve& curve, std::vector<RayCurvePair>& pairs) {
    static const float steps[] = {-1, -0.5f, -0.25f, 0, 0.25f, 0.5f, 1};
    static const glm::vec3 directions[] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {-1, 0, 0},
                                           {0, -1, 0}, {0, 0, -1}, {1, 1, 0},  {1, -1, 0},
                                           {0, 1, 1},  {1, 0, -1}, {-1, 1, 1}, {2, 1, 0}};
    const float radius = std::max(curve[0].w, curve[3].w);
    for (const glm::vec3& direction : directions)
        for (const float u : {0.f, 0.25f, 0.5f, 0.75f, 1.f})
            for (const float a : steps)
                for (const float b : steps) {
                    const glm::vec3 centre = glm::vec3(point_at(to_double(curve), u));
                    const glm::vec3 aside = glm::abs(direction.x) > 0
                                                ? glm::vec3(direction.y, -direction.x, 0)
                                                : glm::vec3(1, 0, 0);
                    const glm::vec3 across = glm::cross(direction, aside);
                    const float reach = 1.25f * radius;
                    Ray ray;
                    ray.direction = direction;
                    ray.origin = centre - 8.f * direction + reach * (a * aside + b * across);
                    if (glm::length(aside) > 0) pairs.push_back({curve, ray});
                }
}

}  // namespace

std::vector<RayFamily> ray_families() {
    return {
        {.name = "gentle"},
        {.name = "curl", .turn_low = 90, .turn_high = 200},
        {.name = "taper", .radius_low = 1e-2, .radius_high = 1e-1, .taper_low = 0, .taper_high = 0.5},
        {.name = "hard taper", .radius_low = 0.1, .radius_high = 0.3, .taper_low = 0, .taper_high = 0.3},
        {.name = "near-parallel", .tilt_low = 1e-3, .tilt_high = 1e-1},
        {.name = "grazing", .lateral_low = 1 - 1.5e-3, .lateral_high = 1 + 1.5e-3},
        {.name = "r/L=1e-2", .radius_low = 1e-2, .radius_high = 1e-2},
        {.name = "r/L=1e-3", .radius_low = 1e-3, .radius_high = 1e-3},
        {.name = "r/L=1e-4", .radius_low = 1e-4, .radius_high = 1e-4},
        {.name = "r/L=1e-5", .radius_low = 1e-5, .radius_high = 1e-5},
        {.name = "far 1e2", .distance_low = 1e2, .distance_high = 1e2},
        {.name = "far 1e4", .distance_low = 1e4, .distance_high = 1e4},
        {.name = "far 1e6", .distance_low = 1e6, .distance_high = 1e6},
        {.name = "offset 1e4", .offset = 1e4},
        {.name = "inside", .inside = true},
        {.name = "degenerate", .shape = RayFamily::Shape::degenerate},
        {.name = "fat curl", .turn_low = 120, .turn_high = 200, .radius_low = 0.3, .radius_high = 0.6},
    };
}

RayFamily ray_family(const std::string& name) {
    const std::vector<RayFamily> all = ray_families();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const RayFamily& f) { return f.name == name; });
    assert(found != all.end());
    return *found;
}

RayCurvePair make_pair(const RayFamily& family, uint64_t index) {
    uint64_t stream = 0;
    for (const char c : family.name) stream = mix_bits(stream + static_cast<unsigned char>(c));
    Random random(20180810, stream, index);
    const CurveD curve = make_curve(family, random);
    return {to_float(curve), make_ray(family, curve, random)};
}

std::vector<RayCurvePair> structured_pairs() {
    const float r = 1.f / 32;
    const Curve straight{glm::vec4(-0.75f, 0, 0, r), {-0.25f, 0, 0, r}, {0.25f, 0, 0, r}, {0.75f, 0, 0, r}};
    const Curve cone{
        glm::vec4(-0.75f, 0, 0, r), {-0.25f, 0, 0, 2 * r / 3}, {0.25f, 0, 0, r / 3}, {0.75f, 0, 0, 0}};
    const Curve arch{glm::vec4(-0.5f, 0, 0, r), {-0.25f, 0.5f, 0, r}, {0.25f, 0.5f, 0, r}, {0.5f, 0, 0, r}};
    const Curve wave{glm::vec4(-0.5f, 0, 0, r), {-0.25f, 0.5f, 0, r}, {0.25f, -0.5f, 0, r}, {0.5f, 0, 0, r}};
    const Curve loop{glm::vec4(-0.25f, 0, 0, r), {0.5f, 0.5f, 0, r}, {-0.5f, 0.5f, 0, r}, {0.25f, 0, 0, r}};
    const Curve eased{glm::vec4(-0.5f, 0, 0, r), {-0.5f, 0, 0, r}, {0.5f, 0, 0, r}, {0.5f, 0, 0, r}};
    const Curve helix{
        glm::vec4(-0.5f, 0, 0, r), {-0.25f, 0.5f, 0, r}, {0.25f, 0, 0.5f, r}, {0.5f, 0, 0, 2 * r}};
    std::vector<RayCurvePair> pairs;
    for (const Curve& curve : {straight, cone, arch, wave, loop, eased, helix}) add_lattice(curve, pairs);
    return pairs;
}

}  // namespace strandlab::testing
