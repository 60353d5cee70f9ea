#include "trace/scene_reference.h"

#include "base/cache.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "primitives/curved_pieces.h"
#include "trace/scene_oracle.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace strandlab {
namespace {

/// Changes whenever the oracle's answers may.
constexpr int oracle_version = 3;

std::string cache_key(const Scene& scene, std::span<const Surface> surfaces, std::span<const Ray> rays) {
    Hash sum;
    for (const Surface& surface : surfaces) sum.add_number(hash(surface));
    for (const SceneInstance& instance : scene.instances) {
        sum.add_number(instance.model);
        sum.add(&instance.world_from_object, sizeof instance.world_from_object);
    }
    return fmt::format("oracle/{} scene={:016x} rays={:016x} count={}", oracle_version, sum.value(),
                       Hash().add(rays).value(), rays.size());
}

static_assert(std::is_trivially_copyable_v<ReferenceHit>);

std::vector<std::byte> packed(const Reference& reference) {
    const size_t count = reference.hits.size(), hit_bytes = count * sizeof(ReferenceHit);
    std::vector<std::byte> bytes(hit_bytes + 2 * count + sizeof(double));
    if (count == 0) return {};
    std::memcpy(bytes.data(), reference.hits.data(), hit_bytes);
    std::memcpy(bytes.data() + hit_bytes, reference.decisive.data(), count);
    std::memcpy(bytes.data() + hit_bytes + count, reference.decisive_place.data(), count);
    std::memcpy(bytes.data() + hit_bytes + 2 * count, &reference.margin, sizeof(double));
    return bytes;
}

std::optional<Reference> unpacked(const std::vector<std::byte>& bytes, size_t count) {
    const size_t hit_bytes = count * sizeof(ReferenceHit);
    if (count == 0 || bytes.size() != hit_bytes + 2 * count + sizeof(double)) return std::nullopt;
    Reference reference{std::vector<ReferenceHit>(count), std::vector<uint8_t>(count),
                        std::vector<uint8_t>(count), 0};
    std::memcpy(reference.hits.data(), bytes.data(), hit_bytes);
    std::memcpy(reference.decisive.data(), bytes.data() + hit_bytes, count);
    std::memcpy(reference.decisive_place.data(), bytes.data() + hit_bytes + count, count);
    std::memcpy(&reference.margin, bytes.data() + hit_bytes + 2 * count, sizeof(double));
    return reference;
}

std::vector<SurfaceInstance> surface_instances(const Scene& scene) {
    std::vector<SurfaceInstance> instances;
    for (const SceneInstance& instance : scene.instances)
        instances.push_back({instance.model, instance.world_from_object, scene.first_curve(instance.model)});
    return instances;
}

/// Three scenes: as it is, and with larger and smaller radii.
Reference trace_instances(const Scene& scene, std::span<const Surface> surfaces, const Curves& curves,
                          std::span<const Ray> rays) {
    const std::vector<SurfaceInstance> instances = surface_instances(scene);
    const DecisiveMargin margin;
    const auto trace = [&](const OracleOptions& options) {
        return SceneOracle(surfaces, instances, options).trace(rays);
    };
    Reference reference;
    for (const Surface& surface : surfaces)
        reference.margin = std::max(reference.margin, relative_margin(surface, margin));
    reference.hits = trace({});
    const auto larger = trace({1 + margin.radius, margin.ulps, margin.ends});
    const auto smaller = trace({1 - margin.radius, margin.ulps, -margin.ends});
    reference.decisive.resize(rays.size());
    reference.decisive_place.resize(rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        const Decided is_decided = decided(rays[i], curves, reference.hits[i], larger[i], smaller[i]);
        reference.decisive[i] = is_decided.strand;
        reference.decisive_place[i] = is_decided.place;
    });
    return reference;
}

}  // namespace

std::vector<Surface> surfaces_of(const Scene& scene, const std::function<Surface(const Curves&)>& make) {
    std::vector<Surface> surfaces;
    for (const Curves& model : scene.models) surfaces.push_back(make(model));
    return surfaces;
}

std::vector<Surface> common_surfaces(const Scene& scene, Caps caps) {
    return surfaces_of(
        scene, [caps](const Curves& curves) { return curved_surface(curves, Surface::Sweep::sphere, caps); });
}

uint64_t hash(const Surface& surface) {
    Hash sum;
    sum.add_number(static_cast<uint64_t>(surface.sweep)).add_number(static_cast<uint64_t>(surface.caps));
    for (const SurfacePiece& piece : surface.pieces) {
        sum.add(piece.control.data(), sizeof piece.control);
        sum.add(&piece.u0, sizeof piece.u0).add(&piece.u1, sizeof piece.u1);
        sum.add_number(piece.curve * 8ull + piece.straight * 4u + piece.begins_strand * 2u +
                       piece.ends_strand);
    }
    for (const SurfaceTriangle& triangle : surface.triangles) {
        sum.add(triangle.vertex.data(), sizeof triangle.vertex)
            .add(triangle.centre.data(), sizeof triangle.centre);
        sum.add(triangle.u.data(), sizeof triangle.u).add_number(triangle.curve);
    }
    return sum.value();
}

std::vector<ReferenceHit> make_scene_hits(const Scene& scene, std::span<const Surface> surfaces,
                                          std::span<const Ray> rays) {
    const std::string key = cache_key(scene, surfaces, rays) + " hits";
    std::vector<ReferenceHit> hits(rays.size());
    const size_t bytes = hits.size() * sizeof(ReferenceHit);
    if (const auto stored = cache_read(key); stored && bytes > 0 && stored->size() == bytes) {
        std::memcpy(hits.data(), stored->data(), bytes);
        return hits;
    }
    hits = scene.is_plain() ? Oracle(surfaces[0]).trace(rays)
                            : SceneOracle(surfaces, surface_instances(scene)).trace(rays);
    cache_write(key, std::as_bytes(std::span(hits)));
    return hits;
}

Reference make_scene_reference(const Scene& scene, std::span<const Surface> surfaces, const Curves& curves,
                               std::span<const Ray> rays) {
    const std::string key = cache_key(scene, surfaces, rays);
    if (const auto bytes = cache_read(key))
        if (auto reference = unpacked(*bytes, rays.size())) return std::move(*reference);
    Reference reference = scene.is_plain() ? make_reference(surfaces[0], curves, rays)
                                           : trace_instances(scene, surfaces, curves, rays);
    cache_write(key, packed(reference));
    return reference;
}

}  // namespace strandlab
