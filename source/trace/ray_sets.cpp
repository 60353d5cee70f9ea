#include "trace/ray_sets.h"

#include "base/byte_source.h"
#include "base/error.h"
#include "base/npy.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/text.h"
#include "scene/spawn.h"
#include "strands/bezier.h"
#include "trace/sampling.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace strandlab {
namespace {

/// Streams of the generator: each kind of ray draws its own numbers from one seed.
enum Stream : uint64_t {
    stream_jitter = 1,
    stream_diffuse,
    stream_interior,
    stream_shuffle,
    stream_ambient,
    stream_grazing
};

Ray ray_from(const glm::dvec3& origin, const glm::dvec3& direction) {
    Ray ray;
    ray.origin = glm::vec3(origin);
    ray.direction = glm::vec3(direction);
    return ray;
}

/// The start of a ray that leaves a surface at point along its unit normal: see secondary_rays.
glm::dvec3 moved_off(const glm::dvec3& point, const glm::dvec3& normal, double radius) {
    const glm::dvec3 size = glm::abs(point);
    const auto largest = static_cast<float>(std::max({size.x, size.y, size.z}));
    return point + normal * common_spawn_offset.distance(radius, largest);
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Where a hit's rays start; nothing leaves a hit that has no usable place or normal.
struct Spawn {
    bool usable = false;
    glm::dvec3 origin{0}, normal{0};
};

Spawn spawn_at(const Ray& ray, const ReferenceHit& hit) {
    if (!hit.is_hit() || hit.starts_inside || !std::isfinite(hit.t) || !is_finite(hit.normal)) return {};
    if (!(glm::dot(hit.normal, hit.normal) > 0.5) || !(hit.radius >= 0)) return {};
    const glm::dvec3 normal = glm::normalize(hit.normal);
    const glm::dvec3 point = glm::dvec3(ray.origin) + hit.t * glm::dvec3(ray.direction);
    return {true, moved_off(point, normal, hit.radius), normal};
}

/// Rays of the usable hits in the order of the hits: direction_of(index, normal) gives each ray's, and a
/// zero direction none. Counts per block, then fills, so that the order is that of one thread.
template <class DirectionOf>
Rays spawned(const PrimaryHits& primary, const DirectionOf& direction_of) {
    assert(primary.rays.size() == primary.hits.size());
    const size_t count = primary.hits.size();
    constexpr size_t block_size = 4096;
    std::vector<std::vector<Ray>> blocks((count + block_size - 1) / block_size);
    parallel_for(blocks.size(), [&](size_t block) {
        const size_t begin = block * block_size, end = std::min(count, begin + block_size);
        for (size_t i = begin; i < end; ++i) {
            const Spawn spawn = spawn_at(primary.rays[i], primary.hits[i]);
            if (!spawn.usable) continue;
            const glm::dvec3 direction = direction_of(i, spawn.normal);
            if (direction != glm::dvec3(0)) blocks[block].push_back(ray_from(spawn.origin, direction));
        }
    });
    Rays rays;
    size_t total = 0;
    for (const auto& block : blocks) total += block.size();
    rays.rays.reserve(total);
    for (const auto& block : blocks) rays.rays.insert(rays.rays.end(), block.begin(), block.end());
    set_launch_shape(rays);
    return rays;
}

double fraction(double x) { return x - std::floor(x); }

/// Places in a pixel, (0, 0) at its top left corner.
glm::dvec2 sample_place(const PictureSize& size, uint64_t seed, size_t pixel, uint32_t sample) {
    if (size.samples == 1) return {0.5, 0.5};
    Random random(seed, stream_jitter, pixel);
    const double x = random.uniform(), y = random.uniform();
    // Powers of 1 / plastic number, the real root of x^3 = x + 1.
    return {fraction(x + sample * 0.75487766624669276), fraction(y + sample * 0.56984029099805327)};
}

/// A random point of a strand's axis, and a direction across it.
struct AxisPoint {
    glm::dvec3 centre, normal;
    double radius;
};

AxisPoint random_axis_point(const Curves& curves, Random& random) {
    const auto any_strand = [&] {
        return curves.strands[random.below(static_cast<uint32_t>(curves.strands.size()))];
    };
    StrandRange strand = any_strand();
    while (strand.count == 0) strand = any_strand();
    const CurveD curve = to_double(curves.curves[strand.first + random.below(strand.count)]);
    const double u = random.uniform();
    const glm::dvec4 centre = point_at(curve, u);
    glm::dvec3 tangent = tangent_at(curve, u);
    if (tangent == glm::dvec3(0)) tangent = sample_sphere(random);
    const glm::dvec3 across = orthogonal_to(tangent), along = glm::cross(tangent, across);
    const glm::dvec2 disc = sample_disc(random);
    const glm::dvec3 sum = across * disc.x + along * disc.y;
    const glm::dvec3 normal = sum == glm::dvec3(0) ? across : glm::normalize(sum);
    return {glm::dvec3(centre), normal, std::max(centre.w, 0.0)};
}

Ray interior_ray(const Curves& curves, uint64_t seed, size_t index) {
    Random random(seed, stream_interior, index);
    const AxisPoint at = random_axis_point(curves, random);
    return ray_from(moved_off(at.centre + at.radius * at.normal, at.normal, at.radius),
                    sample_cosine(random, at.normal));
}

Ray grazing_ray(const Curves& curves, uint64_t seed, size_t index) {
    Random random(seed, stream_grazing, index);
    const AxisPoint at = random_axis_point(curves, random);
    const glm::dvec3 across = orthogonal_to(at.normal), along = glm::cross(at.normal, across);
    const glm::dvec2 disc = sample_disc(random);
    const glm::dvec3 sum = across * disc.x + along * disc.y;
    const glm::dvec3 direction = sum == glm::dvec3(0) ? across : glm::normalize(sum);
    const glm::dvec3 passed = at.centre + at.radius * random.range(0.95, 1.05) * at.normal;
    return ray_from(passed - 20 * at.radius * direction, direction);
}

template <class MakeRay>
Rays rays_of_strands(const Curves& curves, size_t count, std::string_view name, const MakeRay& make) {
    if (curves.curves.empty() || curves.strands.empty())
        fail(ExitCode::bad_input, "--rays {}: the model has no strands for rays to start at", name);
    Rays rays;
    rays.rays.resize(count);
    parallel_for(count, [&](size_t i) { rays.rays[i] = make(i); });
    set_launch_shape(rays);
    return rays;
}

/// The diagonal of the box around the rays' origins.
double diagonal_of(const std::vector<Ray>& rays) {
    if (rays.empty()) return 0;
    glm::dvec3 low(rays.front().origin), high = low;
    for (const Ray& ray : rays) {
        low = glm::min(low, glm::dvec3(ray.origin));
        high = glm::max(high, glm::dvec3(ray.origin));
    }
    return glm::length(high - low);
}

constexpr std::array table = {
    RaySetInfo{"primary", "from the camera through every pixel, row by row", false, false,
               [](const RaySetInput& in) { return primary_rays(in.camera, in.size, in.seed); }},
    RaySetInfo{"shadow", "from the reference's primary hits towards a distant light", true, true,
               [](const RaySetInput& in) { return shadow_rays(in.primary, in.to_light); }},
    RaySetInfo{"diffuse",
               "one bounce: from the reference's primary hits, cosine-distributed about the normal", true,
               false, [](const RaySetInput& in) { return diffuse_rays(in.primary, in.seed); }},
    RaySetInfo{"ambient", "ambient occlusion: like diffuse, but short, and hit or miss only", true, true,
               [](const RaySetInput& in) { return ambient_rays(in.primary, in.seed); }},
    RaySetInfo{"grazing", "past random points of random strands, within 5 % of a radius of the silhouette",
               false, false,
               [](const RaySetInput& in) { return grazing_rays(in.curves, in.size.rays(), in.seed); }},
    RaySetInfo{"interior", "from random points of random strands, cosine-distributed about the normal", false,
               false,
               [](const RaySetInput& in) { return interior_rays(in.curves, in.size.rays(), in.seed); }},
};

}  // namespace

Rays primary_rays(const Camera& camera, const PictureSize& size, uint64_t seed) {
    const double product = double(size.width) * size.height * size.samples;
    if (!(product >= 1 && product <= std::numeric_limits<uint32_t>::max()))
        fail(ExitCode::usage, "--size {}x{} with {} samples: a picture has 1 to {} rays", size.width,
             size.height, size.samples, std::numeric_limits<uint32_t>::max());
    const CameraFrame frame = frame_of(camera);
    const double half = std::tan(camera.fov * (std::numbers::pi / 360));
    Rays rays;
    rays.width = size.width * size.samples;
    rays.height = size.height;
    rays.rays.resize(size.rays());
    parallel_for(size.height, [&](size_t row) {
        const auto y = static_cast<uint32_t>(row);
        for (uint32_t x = 0; x < size.width; ++x)
            for (uint32_t s = 0; s < size.samples; ++s) {
                const size_t pixel = row * size.width + x;
                const glm::dvec2 place = sample_place(size, seed, pixel, s);
                const double across = (2 * (x + place.x) / size.width - 1) * half * size.aspect();
                const double up = (1 - 2 * (y + place.y) / size.height) * half;
                const glm::dvec3 direction = frame.right * across + frame.up * up + frame.forward;
                rays.rays[pixel * size.samples + s] = ray_from(camera.eye, glm::normalize(direction));
            }
    });
    return rays;
}

Rays diffuse_rays(const PrimaryHits& primary, uint64_t seed) {
    return spawned(primary, [&](size_t i, const glm::dvec3& normal) {
        Random random(seed, stream_diffuse, i);
        return sample_cosine(random, normal);
    });
}

Rays ambient_rays(const PrimaryHits& primary, uint64_t seed) {
    Rays rays = spawned(primary, [&](size_t i, const glm::dvec3& normal) {
        Random random(seed, stream_ambient, i);
        return sample_cosine(random, normal);
    });
    const auto reach = static_cast<float>(0.1 * diagonal_of(rays.rays));
    for (Ray& ray : rays.rays) ray.tmax = reach;
    return rays;
}

Rays shadow_rays(const PrimaryHits& primary, const glm::dvec3& to_light) {
    return spawned(primary, [&](size_t, const glm::dvec3& normal) {
        return glm::dot(normal, to_light) > 0 ? to_light : glm::dvec3(0);
    });
}

Rays interior_rays(const Curves& curves, size_t count, uint64_t seed) {
    return rays_of_strands(curves, count, "interior",
                           [&](size_t i) { return interior_ray(curves, seed, i); });
}

Rays grazing_rays(const Curves& curves, size_t count, uint64_t seed) {
    return rays_of_strands(curves, count, "grazing", [&](size_t i) { return grazing_ray(curves, seed, i); });
}

void shuffle(Rays& rays, uint64_t seed) {
    Random random(seed, stream_shuffle);
    for (size_t i = rays.rays.size(); i > 1; --i)
        std::swap(rays.rays[i - 1], rays.rays[random.below(static_cast<uint32_t>(i))]);
}

void set_launch_shape(Rays& rays) {
    const size_t count = rays.rays.size();
    const auto root = static_cast<size_t>(std::ceil(std::sqrt(double(count))));
    const size_t width = std::min(count, (root + 31) / 32 * 32);
    rays.width = static_cast<uint32_t>(width);
    rays.height = width == 0 ? 0 : static_cast<uint32_t>((count + width - 1) / width);
}

LoadedRays load_rays(const std::string& path) {
    const auto rows = read_npy<std::array<float, 8>>(ByteSource::from_file(path), {"<f4", {8}});
    return rays_from_floats(path, {reinterpret_cast<const float*>(rows.data()), rows.size() * 8});
}

LoadedRays rays_from_floats(std::string name, std::span<const float> values) {
    if (values.empty() || values.size() % 8 != 0)
        fail(ExitCode::bad_input, "{}: {} numbers are no rays: each has 8 (ox oy oz tmin dx dy dz tmax)",
             name, values.size());
    LoadedRays loaded;
    loaded.rays.name = std::move(name);
    loaded.rays.rays.resize(values.size() / 8);
    std::memcpy(static_cast<void*>(loaded.rays.rays.data()), values.data(), values.size_bytes());
    loaded.invalid = disable_invalid(loaded.rays.rays);
    return loaded;
}

std::span<const RaySetInfo> ray_sets() { return table; }

const RaySetInfo& ray_set_named(std::string_view name) {
    if (name == "secondary") name = "diffuse";
    for (const RaySetInfo& set : table)
        if (set.name == name) return set;
    std::vector<std::string> names;
    for (const RaySetInfo& set : table) names.emplace_back(set.name);
    const auto guess = nearest(name, names);
    fail(ExitCode::usage, "--rays: no set '{}'{}; choose {}", name,
         guess ? fmt::format(", did you mean '{}'?", *guess) : "", list_of(names));
}

Rays make_rays(const RaySetInfo& set, const RaySetInput& input) {
    Rays rays = set.make(input);
    rays.name = set.name;
    if (!input.shuffled) return rays;
    shuffle(rays, input.seed);
    rays.name += " shuffled";
    return rays;
}

}  // namespace strandlab
