#include "report/shading.h"

#include "base/parallel.h"
#include "base/random.h"
#include "scene/bounds.h"
#include "strands/bezier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

/// What lighting needs to know of the whole model: a ball about the hair, for the shade inside it.
struct Volume {
    glm::dvec3 centre{0};
    double radius = 1;
};

Volume volume_of(const Curves& curves) {
    Box box;
    for (const Curve& curve : curves.curves) {
        box.add(glm::vec3(curve[0]));
        box.add(glm::vec3(curve[3]));
    }
    if (box.is_empty()) return {};
    return {0.5 * (glm::dvec3(box.low) + glm::dvec3(box.high)),
            std::max(0.5 * glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)), 1e-30)};
}

/// The place of a hit on its strand.
struct Place {
    uint32_t strand;
    double along;  // 0 at the root, 1 at the tip
    glm::dvec3 point, tangent, normal, to_eye;
};

Place place_of(const Ray& ray, const Hit& hit, const glm::vec3* normal, const Curves& curves) {
    Place place;
    place.strand = curves.strand_of(hit.curve);
    const StrandRange range = curves.strands[place.strand];
    const double u = hit.u >= 0 ? std::min(double(hit.u), 1.0) : 0.0;  // NaN: the root side
    place.along = (hit.curve - range.first + u) / range.count;
    place.point = glm::dvec3(ray.origin) + double(hit.t) * glm::dvec3(ray.direction);
    place.to_eye = -glm::normalize(glm::dvec3(ray.direction));
    place.tangent = tangent_at(to_double(curves.curves[hit.curve]), u);
    // Without a usable normal: the side of the strand that faces the eye.
    place.normal = normal ? glm::dvec3(*normal) : glm::dvec3(0);
    if (!(glm::dot(place.normal, place.normal) > 0.25 && glm::dot(place.normal, place.normal) < 4))
        place.normal = place.to_eye - glm::dot(place.to_eye, place.tangent) * place.tangent;
    const double size = glm::length(place.normal);
    place.normal = size > 1e-12 ? place.normal / size : place.to_eye;
    return place;
}

/// A strand's own colour: a little lighter or darker, warmer or colder than the hair's, and so is the lock
/// that it grows in (strands whose roots share a cell of the scalp).
glm::vec3 strand_colour(const Curves& curves, uint32_t strand, const Volume& volume,
                        const ShadingOptions& options) {
    const glm::dvec3 root(curves.curves[curves.strands[strand].first][0]);
    const glm::dvec3 cell = glm::floor((root - volume.centre) * (20 / volume.radius));
    uint64_t lock_number = 0;
    for (int axis = 0; axis < 3; ++axis)
        lock_number = (lock_number << 21) ^ static_cast<uint64_t>(static_cast<int64_t>(cell[axis]));
    Random own(0x5747, 0, strand), lock(0x5747, 1, lock_number);
    const double shared = lock.signed_unit();
    const auto brightness =
        static_cast<float>(1 + options.variation * (0.6 * own.signed_unit() + 0.4 * shared));
    const auto warmth = static_cast<float>(1 + 0.2 * options.variation * own.signed_unit());
    return options.hair * glm::vec3(brightness * warmth, brightness, brightness / warmth);
}

/// The highlight of light that a strand reflects like a mirror tilted by shift (Scheuermann 2004).
double highlight(const Place& place, const glm::dvec3& half, double shift, double exponent) {
    const glm::dvec3 tangent = glm::normalize(place.tangent + shift * place.normal);
    const double cosine = glm::dot(tangent, half);
    return std::pow(std::max(0.0, 1 - cosine * cosine), 0.5 * exponent);
}

glm::vec3 lit(const Place& place, const glm::vec3& colour, const Volume& volume,
              const ShadingOptions& options, double visible) {
    const glm::dvec3& light = options.to_light;
    const double along_light = glm::dot(place.tangent, light);
    const double diffuse = std::sqrt(std::max(0.0, 1 - along_light * along_light));
    const glm::dvec3 half = glm::normalize(light + place.to_eye + 1e-9 * place.normal);

    // The hair as a whole turns to the light where its volume does; single strands keep some of theirs.
    const glm::dvec3 outwards = place.point - volume.centre;
    const double distance = glm::length(outwards), depth = std::min(1.0, distance / volume.radius);
    const double wrapped = 0.55 + 0.45 * glm::dot(outwards, light) / std::max(distance, 1e-30);
    const double root = 0.4 + 0.6 * std::min(1.0, 2.5 * place.along);
    const double side = 0.65 + 0.35 * glm::dot(place.normal, light);
    const double direct = visible * wrapped * wrapped * root * side;
    const double rim = 0.5 + 0.5 * glm::dot(place.normal, place.to_eye);

    const auto scattered =
        static_cast<float>(1.3 * direct * diffuse + options.ambient * root * rim * (0.3 + 0.7 * depth));
    const auto white = static_cast<float>(0.30 * direct * highlight(place, half, -0.10, 90));
    const auto coloured = static_cast<float>(3.0 * direct * highlight(place, half, 0.16, 20));
    return colour * (scattered + coloured) + glm::vec3(white);
}

/// One pixel's sums and the sample that its data layers hold.
struct Pixel {
    glm::vec3 colour{0};
    uint32_t hit_count = 0;
    size_t nearest = std::numeric_limits<size_t>::max();  // index of its ray
};

/// The layers of the picture, to be filled pixel by pixel.
struct Layers {
    std::vector<float>*colour, *depth, *normal, *u;
    std::vector<uint32_t>*ids, *mask;

    explicit Layers(Image& image) {
        image.layers.reserve(6);  // so that the pointers stay
        colour = &image.add_floats({"R", "G", "B"});
        depth = &image.add_floats({"depth.Z"});
        normal = &image.add_floats({"normal.X", "normal.Y", "normal.Z"});
        u = &image.add_floats({"u"});
        ids = &image.add_integers({"id.curve", "id.strand"});
        mask = &image.add_integers({"mask"});
    }
};

}  // namespace

Image shade(const Rays& rays, const Hits& hits, const Curves& curves, const ShadingOptions& options,
            std::span<const float> light_visible, std::span<const glm::vec3> behind) {
    const size_t count = size_t(options.width) * options.height;
    assert(rays.rays.size() == count * options.samples && hits.hits.size() == rays.rays.size());
    assert(hits.normals.empty() || hits.normals.size() == hits.hits.size());
    assert(behind.empty() || behind.size() == rays.rays.size());
    assert(light_visible.empty() || light_visible.size() == rays.rays.size());
    Image image;
    image.width = options.width;
    image.height = options.height;
    const Layers layers(image);
    const Volume volume = volume_of(curves);
    const auto is_hit = [&](size_t i) {
        return hits.hits[i].curve < curves.curves.size() && hits.hits[i].t >= 0;
    };

    parallel_for(count, [&](size_t p) {
        const float down =
            (static_cast<float>(p / options.width) + 0.5f) / static_cast<float>(options.height);
        const glm::vec3 background = glm::mix(options.background_top, options.background_bottom, down);
        Pixel pixel;
        for (size_t i = p * options.samples; i < (p + 1) * options.samples; ++i) {
            if (!is_hit(i)) {
                pixel.colour += behind.empty() || std::isnan(behind[i].x) ? background : behind[i];
                continue;
            }
            const glm::vec3* normal = hits.normals.empty() ? nullptr : &hits.normals[i];
            const double visible = light_visible.empty() ? 1.0 : light_visible[i];
            const Place place = place_of(rays.rays[i], hits.hits[i], normal, curves);
            const glm::vec3 hair = strand_colour(curves, place.strand, volume, options);
            pixel.colour += lit(place, hair, volume, options, visible);
            if (pixel.hit_count++ == 0 || hits.hits[i].t < hits.hits[pixel.nearest].t) pixel.nearest = i;
        }
        const glm::vec3 colour = pixel.colour / static_cast<float>(options.samples);
        for (int c = 0; c < 3; ++c) (*layers.colour)[3 * p + c] = colour[c];
        (*layers.mask)[p] = pixel.hit_count;
        (*layers.depth)[p] = std::numeric_limits<float>::infinity();
        (*layers.ids)[2 * p] = (*layers.ids)[2 * p + 1] = no_curve;
        if (pixel.hit_count == 0) return;
        const Hit& hit = hits.hits[pixel.nearest];
        (*layers.depth)[p] = hit.t;
        (*layers.u)[p] = hit.u;
        (*layers.ids)[2 * p] = hit.curve;
        (*layers.ids)[2 * p + 1] = curves.strand_of(hit.curve);
        if (!hits.normals.empty())
            for (int c = 0; c < 3; ++c) (*layers.normal)[3 * p + c] = hits.normals[pixel.nearest][c];
    });
    return image;
}

}  // namespace strandlab
