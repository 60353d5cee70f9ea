#include "trace/reach.h"

#include "base/parallel.h"
#include "trace/bvh.h"
#include "trace/reach_grid.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

namespace strandlab {
namespace {

/// Roundings allowed for, each half of a float's epsilon of the largest number that takes part.
constexpr double roundings = 64 * double(std::numeric_limits<float>::epsilon());

/// Largest sum of the absolute values of a row.
double row_norm(const glm::dmat3& m) {
    double norm = 0;
    for (int row = 0; row < 3; ++row)
        norm = std::max(norm, std::abs(m[0][row]) + std::abs(m[1][row]) + std::abs(m[2][row]));
    return norm;
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Where an instance stands, and what its transform does to rounding errors.
struct Placement {
    uint32_t model = 0;
    bool is_moved = false;
    glm::dmat3 to_world{1.0}, to_object{1.0};
    glm::dvec3 offset{0.0};
    double condition = 1;     // of the transform: relative errors grow by up to this factor
    double stretch = 1;       // by how much lengths grow on the way to the world, at most
    double origin_reach = 0;  // largest coordinate of a ray's origin in object space

    Placement(const SceneInstance& instance, double extent)
        : model(instance.model),
          is_moved(instance.world_from_object != glm::mat4x3(1.0f)),
          to_world(glm::mat3(instance.world_from_object)),
          to_object(glm::inverse(to_world)),
          offset(instance.world_from_object[3]) {
        stretch = row_norm(to_world);
        const double shrink = row_norm(to_object);
        condition = stretch * shrink;
        origin_reach = shrink * (extent + largest(offset));
    }

    bool is_trusted() const {
        constexpr double most = 1e15;
        const glm::dvec3 sum = to_object[0] + to_object[1] + to_object[2];  // of what is not finite: neither
        return std::isfinite(sum.x + sum.y + sum.z) && std::isfinite(origin_reach) && stretch > 1 / most &&
               stretch < most && condition < 1e6;
    }

    /// What of a ray lies in the model's grid.
    std::optional<ReachGrid::Segment> clip(const Ray& ray, const ReachGrid& grid) const {
        const glm::dvec3 origin(ray.origin), direction(ray.direction);
        const double tmin = double(ray.tmin), tmax = double(ray.tmax);
        if (!is_moved) return grid.clip(origin, direction, tmin, tmax);
        return grid.clip(to_object * (origin - offset), to_object * direction, tmin, tmax);
    }

    /// A box around the transformed one, with as much to spare as the errors of that box come to.
    Box in_world_space(const Box& box) const {
        Box world;
        if (box.is_empty()) return world;
        double reach = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
            const glm::dvec3 point(glm::mix(box.low, box.high, high));
            reach = std::max(reach, largest(point));
            world.add(glm::vec3(to_world * point + offset));
        }
        const auto margin =
            static_cast<float>(roundings * (condition * stretch * (reach + origin_reach) + largest(offset)));
        return {world.low - margin, world.high + margin};
    }
};

/// What floats can be trusted with.
bool is_ordinary(const Ray& ray) {
    const double size = largest(glm::dvec3(ray.direction));
    return size >= 1e-15 && size <= 1e15;
}

/// What of the rays matters for all instances.
struct RayExtent {
    double extent = 0;  // largest coordinate of an origin
    bool has_any = false, are_ordinary = true;

    explicit RayExtent(std::span<const Ray> rays) {
        for (const Ray& ray : rays) {
            if (!is_valid(ray)) continue;
            has_any = true;
            are_ordinary &= is_ordinary(ray);
            extent = std::max(extent, largest(glm::dvec3(ray.origin)));
        }
    }
};

/// Marks in the models' grids what rays pass.
class Walk {
  public:
    Walk(std::span<const Placement> placements, std::deque<ReachGrid>& models)
        : placements_(placements), models_(models) {
        std::vector<Box> boxes;
        for (const Placement& placement : placements) {
            boxes.push_back(placement.in_world_space(models[placement.model].bounds()));
            // The hierarchy leaves such boxes out.
            if (!boxes.back().is_empty() && !is_finite(boxes.back())) models[placement.model].mark_all();
        }
        top_ = Bvh(boxes);
    }

    /// Of neighbouring rays.
    void mark(std::span<const Ray> rays) const {
        std::vector<std::pair<uint32_t, uint32_t>> met;  // instance and ray
        for (uint32_t r = 0; r < rays.size(); ++r) {
            const Ray& ray = rays[r];
            if (!is_valid(ray)) continue;
            if (placements_.size() == 1) {
                met.emplace_back(0, r);
                continue;
            }
            const BvhRay world(ray.origin, ray.direction, double(ray.tmin), double(ray.tmax));
            top_.traverse(world, [&](uint32_t instance, double&) {
                met.emplace_back(instance, r);
                return false;
            });
        }
        std::sort(met.begin(), met.end());
        std::vector<ReachGrid::Segment> segments;
        for (size_t begin = 0, end = 0; begin < met.size(); begin = end) {
            const Placement& placement = placements_[met[begin].first];
            ReachGrid& grid = models_[placement.model];
            segments.clear();
            for (end = begin; end < met.size() && met[end].first == met[begin].first; ++end)
                if (const auto segment = placement.clip(rays[met[end].second], grid))
                    segments.push_back(*segment);
            grid.mark(segments);
        }
    }

  private:
    static bool is_finite(const Box& box) {
        const glm::dvec3 sum = glm::dvec3(box.low) + glm::dvec3(box.high);
        return std::isfinite(sum.x + sum.y + sum.z);
    }

    std::span<const Placement> placements_;
    std::deque<ReachGrid>& models_;
    Bvh top_;
};

/// The grids of all models, with boxes wide enough for every instance of each.
std::deque<ReachGrid> grids_of(const Scene& scene, std::span<const Placement> placements) {
    std::vector<double> relative(scene.models.size()), absolute(scene.models.size());
    for (const Placement& placement : placements) {
        if (!placement.is_trusted()) continue;
        double& reach = relative[placement.model];
        double& margin = absolute[placement.model];
        reach = std::max(reach, roundings * placement.condition);
        margin = std::max(margin, roundings * placement.condition * placement.origin_reach);
    }
    std::deque<ReachGrid> models;
    for (size_t m = 0; m < scene.models.size(); ++m)
        models.emplace_back(scene.models[m], relative[m], absolute[m]);
    return models;
}

/// Every sixteenth block of neighbouring rays, or the others.
void walk_blocks(const Walk& walk, std::span<const Ray> rays, bool is_first) {
    constexpr size_t block = 512, stride = 16;
    parallel_for((rays.size() + block - 1) / block, [&](size_t i) {
        if ((i % stride == 0) == is_first)
            walk.mark(rays.subspan(i * block, std::min(block, rays.size() - i * block)));
    });
}

bool meets_all(const std::vector<std::vector<uint8_t>>& met) {
    return std::all_of(met.begin(), met.end(), [](const std::vector<uint8_t>& model) {
        return std::find(model.begin(), model.end(), 0) == model.end();
    });
}

}  // namespace

std::vector<std::vector<uint8_t>> strands_within_reach(const Scene& scene, std::span<const Ray> rays) {
    const RayExtent extent(rays);
    std::vector<Placement> placements;
    for (const SceneInstance& instance : scene.instances) placements.emplace_back(instance, extent.extent);
    std::deque<ReachGrid> models = grids_of(scene, placements);
    for (const Placement& placement : placements)
        if (extent.has_any && !(placement.is_trusted() && extent.are_ordinary))
            models[placement.model].mark_all();
    const Walk walk(placements, models);
    // A share of the rays first: where they meet everything, the others have nothing to add.
    std::vector<std::vector<uint8_t>> met;
    for (const bool is_first : {true, false}) {
        walk_blocks(walk, rays, is_first);
        met.clear();
        for (size_t m = 0; m < models.size(); ++m) met.push_back(models[m].strands_met(scene.models[m]));
        if (is_first && meets_all(met)) break;
    }
    return met;
}

}  // namespace strandlab
