#include "report/distant_pictures.h"

#include "measure/flip.h"
#include "report/case_images.h"
#include "report/shading.h"
#include "trace/occluder.h"
#include "trace/ray_sets.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace strandlab {

struct DistantPictures::View {
    DistantView shape;
    double scale = 1;
    Rays rays, shadow_rays;
    std::vector<ReferenceHit> reference;
    Hits reference_hits, reference_shadows;
    std::vector<glm::vec3> reference_picture;
};

namespace {

std::optional<double> depth_bias(const Rays& rays, const Hits& hits,
                                 std::span<const ReferenceHit> reference) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < reference.size(); ++i) {
        if (!hits.hits[i].is_hit() || !reference[i].is_hit()) continue;
        const double length = glm::length(glm::dvec3(rays.rays[i].direction));
        const double bias = (double(hits.hits[i].t) - reference[i].t) * length / reference[i].radius;
        if (!std::isfinite(bias)) continue;
        sum += bias;
        ++count;
    }
    return count > 0 ? std::optional(sum / double(count)) : std::nullopt;
}

}  // namespace

DistantPictures::DistantPictures(const CaseInput& input, const Camera& camera, uint32_t width,
                                 uint32_t height, uint64_t seed, Caps caps)
    : input_(input), to_light_(light_direction(camera)) {
    const double shrink = std::min(1.0, std::sqrt(double(pixels) / (double(width) * height)));
    const auto side = [&](uint32_t full) {
        return std::max(1u, static_cast<uint32_t>(std::lround(shrink * full)));
    };
    const std::vector<Surface> surfaces = common_surfaces(input.scene, caps);
    const Occluder body(input.scene.occluder);
    for (double scale = 1; scale <= farthest; scale *= 2) {
        View& view = views_.emplace_back();
        view.scale = scale;
        view.shape = distant_view(camera, side(width), side(height), samples, scale);
        fill(view, surfaces, body, seed);
        extent_ = std::max({extent_, extent_of(view.rays), extent_of(view.shadow_rays)});
    }
}

DistantPictures::~DistantPictures() = default;

void DistantPictures::fill(View& view, std::span<const Surface> surfaces, const Occluder& body,
                           uint64_t seed) const {
    const auto& [camera, width, height, samples_of_pixel] = view.shape;
    view.rays = primary_rays(camera, {width, height, samples_of_pixel}, seed);
    body.cut(view.rays.rays);
    view.reference = make_scene_hits(input_.scene, surfaces, view.rays.rays);
    view.reference_hits = hits_of(view.reference);
    view.reference_picture = picture(view, view.reference_hits);
    view.shadow_rays = shadow_rays({view.rays.rays, view.reference}, to_light_);
    body.cut(view.shadow_rays.rays);
    view.reference_shadows = hits_of(make_scene_hits(input_.scene, surfaces, view.shadow_rays.rays));
}

std::vector<glm::vec3> DistantPictures::picture(const View& view, const Hits& hits) const {
    ShadingOptions shading;
    shading.width = view.shape.width;
    shading.height = view.shape.height;
    shading.samples = view.shape.samples;
    shading.to_light = to_light_;
    const Image image = shade(view.rays, hits, input_.curves, shading);
    const std::vector<float>& values = image.with_channel("R")->floats();
    std::vector<glm::vec3> colours(values.size() / 3);
    for (size_t i = 0; i < colours.size(); ++i)
        colours[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return colours;
}

std::vector<DistantError> DistantPictures::errors_of(const PrimitiveChoice& choice) const {
    CaseInput input = input_;
    input.options.ray_extent = object_extent(input.scene, extent_);
    const PreparedCase prepared = prepare_case(input, choice);
    std::vector<DistantError> errors;
    for (const View& view : views_) {
        const Hits hits = prepared.traced->trace(view.rays, {.samples = 1}).hits;
        Hits shadows;
        if (!view.shadow_rays.rays.empty())
            shadows = prepared.traced->trace(view.shadow_rays, {.shadow = true, .samples = 1}).hits;
        const auto& [camera, width, height, samples_of_pixel] = view.shape;
        errors.push_back(
            {view.scale, view.rays.rays.size(),
             compare_detail(view.reference_hits, hits, samples_of_pixel, view.reference_shadows, shadows),
             depth_bias(view.rays, hits, view.reference),
             mean_flip(view.reference_picture, picture(view, hits), width, height)});
    }
    return errors;
}

}  // namespace strandlab
