#include "trace/occluder.h"

#include "base/parallel.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace strandlab {
namespace {

struct Place {
    double t, u, v;  // ray parameter, barycentric coordinates of the second and the third corner
};

/// Where the line meets the triangle (Moeller and Trumbore 1997), from both sides.
std::optional<Place> meeting_place(const glm::dvec3& origin, const glm::dvec3& direction,
                                   const Triangle& triangle) {
    const glm::dvec3 a(triangle[0]), ab = glm::dvec3(triangle[1]) - a, ac = glm::dvec3(triangle[2]) - a;
    const glm::dvec3 p = glm::cross(direction, ac), s = origin - a, q = glm::cross(s, ab);
    const double inverse = 1 / glm::dot(ab, p), u = glm::dot(s, p) * inverse,
                 v = glm::dot(direction, q) * inverse;
    constexpr double slack = 1e-12;  // no ray slips between two triangles
    if (!(u >= -slack && v >= -slack && u + v <= 1 + slack)) return std::nullopt;
    return Place{glm::dot(ac, q) * inverse, u, v};
}

glm::dvec3 area_vector(const Triangle& triangle) {
    const glm::dvec3 a(triangle[0]);
    return glm::cross(glm::dvec3(triangle[1]) - a, glm::dvec3(triangle[2]) - a);
}

/// Corner normals: the sum over all triangles with a corner at the same place.
std::vector<std::array<glm::dvec3, 3>> smooth_normals(const std::vector<Triangle>& triangles) {
    const auto before = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::vec3, glm::dvec3, decltype(before)> sums(before);
    for (const Triangle& triangle : triangles)
        for (const glm::vec3& corner : triangle)
            sums.try_emplace(corner, 0.0).first->second += area_vector(triangle);
    std::vector<std::array<glm::dvec3, 3>> normals(triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& sum = sums.at(triangles[i][k]);
            normals[i][k] = glm::length(sum) > 0 ? glm::normalize(sum) : glm::dvec3(0);
        }
    return normals;
}

}  // namespace

Occluder::Occluder(std::span<const Triangle> triangles) : triangles_(triangles.begin(), triangles.end()) {
    normals_ = smooth_normals(triangles_);
    std::vector<Box> boxes(triangles_.size());
    for (size_t i = 0; i < boxes.size(); ++i)
        for (const glm::vec3& p : triangles_[i]) boxes[i].add(p);
    bvh_ = Bvh(boxes);
}

std::optional<Occluder::Meeting> Occluder::meet(const Ray& ray) const {
    if (!is_valid(ray)) return std::nullopt;
    const glm::dvec3 origin(ray.origin), direction(ray.direction);
    std::optional<uint32_t> nearest;
    Place place{};
    bvh_.traverse(BvhRay(origin, direction, ray.tmin, ray.tmax), [&](uint32_t item, double& tmax) {
        const auto met = meeting_place(origin, direction, triangles_[item]);
        if (!met || !(met->t >= double(ray.tmin) && met->t <= tmax)) return false;
        place = *met;
        tmax = met->t;
        nearest = item;
        return false;
    });
    if (!nearest) return std::nullopt;
    const auto& corners = normals_[*nearest];
    const double side = glm::dot(area_vector(triangles_[*nearest]), direction) > 0 ? -1 : 1;
    const glm::dvec3 normal =
        (1 - place.u - place.v) * corners[0] + place.u * corners[1] + place.v * corners[2];
    const double size = glm::length(normal);
    return Meeting{place.t, size > 0 ? side / size * normal : -glm::normalize(direction)};
}

void Occluder::cut(std::vector<Ray>& rays) const {
    constexpr size_t block = 1024;
    parallel_for((rays.size() + block - 1) / block, [&](size_t b) {
        for (size_t i = b * block, end = std::min(rays.size(), i + block); i < end; ++i)
            if (const auto meeting = meet(rays[i]))
                rays[i].tmax = std::max(rays[i].tmin, std::min(rays[i].tmax, static_cast<float>(meeting->t)));
    });
}

}  // namespace strandlab
