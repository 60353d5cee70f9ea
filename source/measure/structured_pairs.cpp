// Rays with exact relations to curves: they find faults that random rays never show.
#include "measure/stress_families.h"

#include <algorithm>

namespace strandlab {
namespace {

void add_lattice(const Curve& curve, std::vector<StressPair>& pairs) {
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
                    if (glm::length(aside) > 0) pairs.push_back({{curve}, ray});
                }
}

std::vector<StressPair> make_pairs() {
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
    std::vector<StressPair> pairs;
    for (const Curve& curve : {straight, cone, arch, wave, loop, eased, helix}) add_lattice(curve, pairs);
    return pairs;
}

}  // namespace

std::span<const StressPair> structured_pairs() {
    static const std::vector<StressPair> all = make_pairs();
    return all;
}

}  // namespace strandlab
