#include "commands/occluder_shading.h"

#include "trace/ray_sets.h"

#include <limits>

namespace strandlab {
namespace {

constexpr glm::vec3 skin{0.42f, 0.25f, 0.18f};
constexpr float lift = 1e-4f;  // of shadow rays off the body, relative to the distance of the eye

}  // namespace

std::vector<glm::vec3> occluder_colours(const Occluder& occluder, const Rays& rays, const TracedScene& scene,
                                        const ShadingOptions& shading, bool shadows) {
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    std::vector<glm::vec3> colours(rays.rays.size(), glm::vec3(none));
    std::vector<size_t> owner;
    std::vector<float> diffuse;
    Rays to_light;
    for (size_t i = 0; i < rays.rays.size(); ++i) {
        const Ray& ray = rays.rays[i];
        const auto meeting = occluder.meet(ray);
        if (!meeting) continue;
        const auto cosine = static_cast<float>(glm::dot(meeting->normal, shading.to_light));
        colours[i] = skin * shading.ambient * (0.7f + 0.3f * static_cast<float>(meeting->normal.y));
        if (!(cosine > 0)) continue;
        const glm::vec3 point = ray.origin + static_cast<float>(meeting->t) * ray.direction;
        const float off = lift * static_cast<float>(meeting->t) * glm::length(ray.direction);
        const Ray shadow{point + off * glm::vec3(meeting->normal), 0.0f, glm::vec3(shading.to_light), 1e30f};
        if (shadows && occluder.meet(shadow)) continue;
        to_light.rays.push_back(shadow);
        owner.push_back(i);
        diffuse.push_back(cosine);
    }
    std::vector<bool> dark(owner.size());
    if (shadows && !owner.empty()) {
        set_launch_shape(to_light);
        const TraceResult shadow = scene.trace(to_light, {.shadow = true, .samples = 1, .warm_up_ms = 0});
        for (size_t k = 0; k < owner.size(); ++k) dark[k] = shadow.hits.hits[k].is_hit();
    }
    for (size_t k = 0; k < owner.size(); ++k)
        if (!dark[k]) colours[owner[k]] += skin * diffuse[k];
    return colours;
}

}  // namespace strandlab
