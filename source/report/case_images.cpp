#include "report/case_images.h"

#include "base/parallel.h"
#include "report/shading.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>

namespace strandlab {
namespace {

/// Linear colours; those of wrong answers are the ones of the report's bars.
glm::vec3 colour_of(const RayError& error) {
    switch (error.outcome) {
        case Outcome::agreed_miss: return glm::vec3(0.006f);
        case Outcome::false_miss: return {0.02f, 0.25f, 1.0f};
        case Outcome::false_hit: return {1.0f, 0.06f, 0.02f};
        case Outcome::wrong_strand: return {0.55f, 0.06f, 0.65f};
        case Outcome::wrong_place: return {0.95f, 0.45f, 0.02f};
        case Outcome::nan: return glm::vec3(1);
        case Outcome::match: break;
    }
    const float distance = error.measures[static_cast<size_t>(Measure::distance)];
    const float decades = std::log10(std::max(distance, 1e-5f) / 1e-5f) / std::log10(0.5f / 1e-5f);
    return glm::vec3(std::isfinite(decades) ? 0.03f + 0.5f * std::clamp(decades, 0.0f, 1.0f) : 0.03f);
}

}  // namespace

Image error_map(const ComparisonInput& input, uint32_t width, uint32_t height) {
    assert(input.rays.size() == size_t(width) * height);
    Image image;
    image.width = width;
    image.height = height;
    std::vector<float>& pixels = image.add_floats({"R", "G", "B"});
    const RayErrors errors(input);
    parallel_for(input.rays.size(), [&](size_t i) {
        const glm::vec3 colour = colour_of(errors.of(i));
        for (int channel = 0; channel < 3; ++channel)
            pixels[3 * i + static_cast<size_t>(channel)] = colour[channel];
    });
    return image;
}

Hits hits_of(std::span<const ReferenceHit> reference) {
    Hits hits;
    hits.hits.resize(reference.size());
    hits.normals.resize(reference.size());
    for (size_t i = 0; i < reference.size(); ++i) {
        const ReferenceHit& hit = reference[i];
        if (!hit.is_hit()) continue;
        hits.hits[i] = {static_cast<float>(hit.t), static_cast<float>(hit.u), hit.curve, hit.instance};
        hits.normals[i] = glm::vec3(hit.normal);
    }
    return hits;
}

CaseImages write_case_images(const CasePicture& picture) {
    const auto path = [&](const std::string& name) {
        return (std::filesystem::path(picture.folder) / (picture.scene + "_" + name + ".png")).string();
    };
    ShadingOptions shading;
    shading.width = picture.width;
    shading.height = picture.height;
    shading.to_light = picture.to_light;
    CaseImages images;
    images.rendered = path(picture.label);
    write_image(images.rendered, shade(picture.rays, picture.hits, picture.curves, shading));
    if (picture.reference.empty()) return images;
    images.reference = path("reference");
    write_image(images.reference, shade(picture.rays, hits_of(picture.reference), picture.curves, shading));
    images.error_map = path(picture.label + "_errors");
    const ComparisonInput input{.rays = picture.rays.rays,
                                .hits = picture.hits.hits,
                                .reference = picture.reference,
                                .curves = &picture.curves,
                                .world_from_object = picture.world_from_object};
    write_image(images.error_map, error_map(input, picture.width, picture.height));
    return images;
}

}  // namespace strandlab
