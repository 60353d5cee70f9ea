#include "measure/lod_sweep.h"

#include "trace/ray_sets.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace strandlab {
namespace {

/// Coverage and mean depth of a pixel.
struct PixelView {
    double coverage = 0, depth = 0;
};

PixelView pixel_view(const Hits& hits, size_t first, uint32_t samples) {
    uint32_t count = 0;
    double depth = 0;
    for (size_t i = first; i < first + samples; ++i) {
        if (!hits.hits[i].is_hit()) continue;
        ++count;
        depth += double(hits.hits[i].t);
    }
    return {double(count) / samples, count > 0 ? depth / count : 0.0};
}

double hit_share(const Hits& hits) {
    size_t count = 0;
    for (const Hit& hit : hits.hits) count += hit.is_hit();
    return hits.hits.empty() ? 0 : double(count) / double(hits.hits.size());
}

}  // namespace

DistantView distant_view(const Camera& camera, uint32_t width, uint32_t height, uint32_t samples,
                         double times) {
    DistantView view{camera, std::max(1u, static_cast<uint32_t>(width / times)),
                     std::max(1u, static_cast<uint32_t>(height / times)), samples};
    view.camera.eye = camera.target + times * (camera.eye - camera.target);
    const double tangent = std::tan(camera.fov * (std::numbers::pi / 360)) / times;
    view.camera.fov = std::atan(tangent) * (360 / std::numbers::pi);
    const double rays = double(width) * height * samples;
    view.samples = std::max(1u, static_cast<uint32_t>(rays / (double(view.width) * view.height)));
    return view;
}

DetailError compare_detail(const Hits& full, const Hits& less, uint32_t samples, const Hits& full_shadow,
                           const Hits& less_shadow) {
    assert(full.hits.size() == less.hits.size() && full.hits.size() % samples == 0);
    DetailError error;
    double square = 0, depth = 0, less_covered = 0, full_covered = 0;
    size_t seen = 0, deep = 0;
    for (size_t first = 0; first < full.hits.size(); first += samples) {
        const PixelView a = pixel_view(full, first, samples), b = pixel_view(less, first, samples);
        full_covered += a.coverage;
        less_covered += b.coverage;
        if (a.coverage == 0 && b.coverage == 0) continue;
        ++seen;
        square += (b.coverage - a.coverage) * (b.coverage - a.coverage);
        if (std::min(a.coverage, b.coverage) < 0.5) continue;
        ++deep;
        depth += b.depth - a.depth;
    }
    error.coverage = hit_share(full);
    if (full_covered > 0) error.coverage_bias = less_covered / full_covered - 1;
    if (seen > 0) error.coverage_rms = std::sqrt(square / double(seen));
    if (deep > 0) error.depth_bias = depth / double(deep);
    error.transmittance = 1 - hit_share(full_shadow);
    error.transmittance_bias = hit_share(full_shadow) - hit_share(less_shadow);
    return error;
}

Rays detail_shadow_rays(const Rays& primary, const Hits& hits, const glm::dvec3& to_light, float off) {
    Rays rays;
    rays.name = "detail shadow";
    for (size_t i = 0; i < primary.rays.size(); ++i) {
        if (!hits.hits[i].is_hit()) continue;
        const Ray& ray = primary.rays[i];
        const glm::vec3 direction = glm::normalize(ray.direction);
        const glm::vec3 start = ray.origin + hits.hits[i].t * ray.direction - off * direction;
        rays.rays.push_back({start, 0.0f, glm::vec3(to_light), 1e30f});
    }
    set_launch_shape(rays);
    return rays;
}

}  // namespace strandlab
