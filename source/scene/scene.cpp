#include "scene/scene.h"

#include "base/hash.h"
#include "base/parallel.h"
#include "scene/bounds.h"

#include <algorithm>

namespace strandlab {

uint32_t Scene::first_curve(uint32_t model) const {
    size_t first = 0;
    for (uint32_t i = 0; i < model; ++i) first += models[i].curves.size();
    return static_cast<uint32_t>(first);
}

size_t Scene::curve_count() const {
    size_t count = 0;
    for (const Curves& model : models) count += model.curves.size();
    return count;
}

size_t Scene::strand_count() const {
    size_t count = 0;
    for (const Curves& model : models) count += model.strands.size();
    return count;
}

bool Scene::is_plain() const {
    return models.size() == 1 && instances.size() == 1 && instances[0].world_from_object == glm::mat4x3(1.0f);
}

Scene scene_of(std::string name, Curves curves) {
    Scene scene;
    scene.name = std::move(name);
    scene.models.push_back(std::move(curves));
    scene.instances.push_back({});
    return scene;
}

Curves all_curves(const Scene& scene) {
    if (scene.models.size() == 1) return scene.models.front();
    Curves all;
    for (const Curves& model : scene.models) {
        const auto first = static_cast<uint32_t>(all.curves.size());
        all.curves.insert(all.curves.end(), model.curves.begin(), model.curves.end());
        for (const StrandRange& strand : model.strands)
            all.strands.push_back({first + strand.first, strand.count});
    }
    return all;
}

namespace {

/// World points that are worth listing one by one.
constexpr size_t most_world_points = 200'000'000;

size_t world_point_count(const Scene& scene) {
    size_t count = 0;
    for (const SceneInstance& instance : scene.instances)
        count += 4 * scene.models[instance.model].curves.size();
    return count;
}

/// Corners of the box of every instance's model.
std::vector<glm::vec4> world_corners(const Scene& scene) {
    std::vector<Box> boxes(scene.models.size());
    parallel_for(boxes.size(), [&](size_t m) {
        for (const Curve& curve : scene.models[m].curves)
            for (const glm::vec4& point : curve) {
                boxes[m].add(glm::vec3(point) - point.w);
                boxes[m].add(glm::vec3(point) + point.w);
            }
    });
    std::vector<glm::vec4> points;
    for (const SceneInstance& instance : scene.instances) {
        const Box& box = boxes[instance.model];
        for (int corner = 0; corner < 8 && !box.is_empty(); ++corner) {
            const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
            points.emplace_back(
                instance.world_from_object * glm::vec4(glm::mix(box.low, box.high, high), 1.0f), 0.0f);
        }
    }
    return points;
}

}  // namespace

std::vector<glm::vec4> world_points(const Scene& scene) {
    if (world_point_count(scene) > most_world_points) return world_corners(scene);
    std::vector<glm::vec4> points;
    for (const SceneInstance& instance : scene.instances) {
        const glm::mat4x3& m = instance.world_from_object;
        const float stretch = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
        for (const Curve& curve : scene.models[instance.model].curves)
            for (const glm::vec4& point : curve)
                points.emplace_back(m * glm::vec4(glm::vec3(point), 1.0f), point.w * stretch);
    }
    return points;
}

float object_extent(const Scene& scene, float extent) {
    float largest = scene.is_plain() ? extent : 0;
    for (const SceneInstance& instance : scene.instances) {
        const glm::mat3 inverse = glm::inverse(glm::mat3(instance.world_from_object));
        const glm::vec3 reach = extent + glm::abs(instance.world_from_object[3]);
        for (int row = 0; row < 3; ++row) {
            const glm::vec3 numbers(inverse[0][row], inverse[1][row], inverse[2][row]);
            if (!scene.is_plain()) largest = std::max(largest, glm::dot(glm::abs(numbers), reach));
        }
    }
    return largest;
}

uint64_t hash(const Scene& scene) {
    Hash sum;
    for (const Curves& model : scene.models) sum.add_number(hash(model));
    for (const SceneInstance& instance : scene.instances) {
        sum.add_number(instance.model);
        sum.add(&instance.world_from_object, sizeof instance.world_from_object);
    }
    if (!scene.occluder.empty()) sum.add(std::span<const Triangle>(scene.occluder));
    return sum.value();
}

}  // namespace strandlab
