#include "measure/stress_spawn.h"

#include "base/parallel.h"
#include "measure/ray_error.h"
#include "measure/stress_leaves.h"
#include "strands/bezier.h"
#include "trace/oracle.h"
#include "trace/sampling.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace strandlab {
namespace {

constexpr uint64_t spawn_stream = 0x7370'6177'6e;

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The ray's point brought back onto the plane of a triangle, as interpolating its vertices gives it, with
/// the plane's normal on the side of the ray.
SpawnPoint on_triangle(const SurfaceTriangle& triangle, const Ray& ray, double t) {
    const glm::dvec3 a(triangle.vertex[0]), b(triangle.vertex[1]), c(triangle.vertex[2]);
    const glm::dvec3 first(triangle.centre[0]);
    const glm::dvec3 other(triangle.centre[1] == triangle.centre[0] ? triangle.centre[2]
                                                                    : triangle.centre[1]);
    glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal), length = glm::length(other - first);
    if (!(area > 0 && length > 0)) return {};
    const glm::dvec3 direction(ray.direction), along = (other - first) / length;
    normal *= (glm::dot(normal, direction) > 0 ? -1 : 1) / area;
    glm::dvec3 point = glm::dvec3(ray.origin) + t * direction;
    point -= normal * glm::dot(normal, point - a);
    const glm::dvec3 aside = glm::normalize(glm::cross(along, normal));
    const double across = glm::dot(point - first, aside);
    SpawnPoint result;
    result.usable = true;
    result.place.point = glm::vec3(point);
    result.place.normal = glm::vec3(normal);
    result.place.radius = glm::length(triangle.vertex[0] - triangle.centre[0]);
    result.place.size = coordinate_size(triangle);
    result.place.aside = glm::vec3(across < 0 ? -aside : aside);
    result.place.across = static_cast<float>(std::abs(across));
    return result;
}

SpawnPoint on_piece(const SurfacePiece& piece, Surface::Sweep sweep, const LeafHit<float>& hit) {
    SpawnPoint result;
    result.place.normal = hit.normal;
    result.usable = surface_point(piece, sweep, hit.u, hit.normal, result.place.point);
    const float v = std::clamp((hit.u - piece.u0) / (piece.u1 - piece.u0), 0.0f, 1.0f);
    const CurveD c = to_double(piece.control);
    result.place.radius =
        static_cast<float>(piece.straight ? glm::mix(c[0].w, c[3].w, double(v)) : point_at(c, v).w);
    result.place.size = coordinate_size(piece);
    return result;
}

void draw_directions(uint64_t seed, uint64_t index, SpawnPoint& point) {
    Random random(seed, spawn_stream, index);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(point.place.normal));
    for (size_t k = 0; k < spawn_directions; ++k) {
        glm::dvec3 direction = sample_cosine(random, normal);
        if (k >= spawn_directions / 2) {
            const glm::dvec3 aside = direction - normal * glm::dot(normal, direction);
            const double cosine = std::pow(10.0, -1 - 3 * random.uniform()), size = glm::length(aside);
            direction = (size > 0 ? aside / size : orthogonal_to(normal)) * std::sqrt(1 - cosine * cosine) +
                        normal * cosine;
        }
        point.directions[k] = glm::vec3(direction);
    }
}

/// The oracle of one strand, made when it is first asked.
class LazyOracle {
  public:
    explicit LazyOracle(const Surface& part) : part_(part) {}

    /// Whether a hit at t of the ray that starts at this distance from the surface is nearer than anything
    /// that it could rightly meet.
    bool refutes(const SpawnPoint& point, size_t direction, double distance, double t) {
        if (!oracle_) oracle_.emplace(part_, larger);
        const Ray ray = point.ray(direction, distance);
        const double length = glm::length(glm::dvec3(ray.direction));
        const double allowed = std::max(0.5 * point.place.radius / length, 8 * float_ulp(t));
        const auto meets = [&](const Ray& from) {
            const ReferenceHit exact = oracle_->trace(from, OracleOptions{});
            return exact.is_hit() && exact.t <= t + allowed;
        };
        if (meets(ray) || (distance > 0 && meets(point.ray(direction, distance / 2)))) return false;
        const ReferenceHit grown = oracle_->trace(ray, larger);
        return !(grown.is_hit() && std::abs(grown.t - t) <= allowed);
    }

  private:
    static constexpr OracleOptions larger{1 + 1e-3, 8, 1e-3};
    const Surface& part_;
    std::optional<Oracle> oracle_;
};

/// One point's share of the tally.
struct PointResult {
    uint32_t self_hits = 0, unmoved = 0, own_hits = 0;
    double radii_needed = 0, ulps_needed = 0;
};

struct Strand {
    const Primitive& primitive;
    const Geometry& geometry;
    std::span<const uint32_t> leaves;

    std::optional<double> first_hit(const Ray& ray) const {
        const auto best =
            nearest_hit<float>(primitive.cpu, geometry, leaves, ray, [](uint32_t, const LeafHit<float>&) {});
        return best.found() ? std::optional<double>(best.hit.t) : std::nullopt;
    }
};

/// The least offset of a direction from which on there is no self-hit; `zero` for none at all.
void find_least_offset(const Strand& strand, const SpawnPoint& point, size_t direction, LazyOracle& oracle,
                       PointResult& result) {
    const double ulp = float_ulp(point.place.size);
    double needed = 2 * std::max(0.25 * double(point.place.radius), 16 * ulp);
    const double least = std::max(std::ldexp(double(point.place.radius), -26), ulp / 16);
    const auto self_hit = [&](double distance) {
        const Ray ray = point.ray(direction, distance);
        const auto t = strand.first_hit(ray);
        return t && oracle.refutes(point, direction, distance, *t);
    };
    bool free = true;
    while (free && needed / 2 >= least) {
        free = !self_hit(needed / 2);
        if (free) needed /= 2;
    }
    if (self_hit(0))
        ++result.unmoved;
    else if (free)
        needed = 0;
    result.radii_needed = std::max(result.radii_needed, needed / point.place.radius);
    result.ulps_needed = std::max(result.ulps_needed, needed / ulp);
}

PointResult spawn_all(const Strand& strand, const SpawnPoint& point, const Surface& part) {
    LazyOracle oracle(part);
    PointResult result;
    const double distance = strand.primitive.spawn.distance(point.place.radius, point.place.size);
    for (size_t k = 0; k < spawn_directions; ++k) {
        if (const auto t = strand.first_hit(point.ray(k, distance)))
            ++(oracle.refutes(point, k, distance, *t) ? result.self_hits : result.own_hits);
        find_least_offset(strand, point, k, oracle, result);
    }
    return result;
}

/// One ray for each point; of points that are not usable, an invalid one, which misses.
std::vector<Ray> rays_of(std::span<const SpawnPoint> points, const SpawnOffset& offset, size_t direction) {
    std::vector<Ray> rays(points.size());
    for (size_t i = 0; i < points.size(); ++i)
        if (points[i].usable)
            rays[i] = points[i].ray(direction, offset.distance(points[i].place.radius, points[i].place.size));
        else
            rays[i].direction = glm::vec3(0);
    return rays;
}

void count_points(std::span<const SpawnPoint> points, SpawnTally& tally) {
    for (const SpawnPoint& point : points) tally.hits += point.usable;
    tally.rays = spawn_directions * tally.hits;
}

}  // namespace

Ray SpawnPoint::ray(size_t direction, double distance) const {
    Ray ray;
    ray.origin = spawn_origin(place, static_cast<float>(distance));
    ray.direction = directions[direction];
    return ray;
}

std::vector<SpawnPoint> spawn_points(const Primitive& primitive, const Geometry& geometry,
                                     const Surface& surface, const StressPairs& pairs) {
    require_cpu_version(primitive);
    const StressRange& range = pairs.range;
    const StrandLeaves leaves(geometry, range.count, range.family->curves);
    const std::vector<Surface> parts = strand_surfaces(surface, range.count, range.family->curves);
    std::vector<SpawnPoint> points(range.count);
    parallel_for(range.count, [&](size_t i) {
        const Ray& ray = pairs.rays[i];
        if (!is_valid(ray)) return;
        const auto best = nearest_hit<float>(primitive.cpu, geometry, leaves.of(i), ray,
                                             [](uint32_t, const LeafHit<float>&) {});
        if (!best.found() || !std::isfinite(best.hit.t)) return;
        SpawnPoint& point = points[i];
        if (geometry.is_triangles())
            point = on_triangle(surface.triangles[best.leaf], ray, best.hit.t);
        else if (const SurfacePiece* piece = piece_at(parts[i], geometry.leaves[best.leaf].curve, best.hit.u))
            point = on_piece(*piece, surface.sweep, best.hit);
        point.usable = point.usable && is_finite(point.place.point) && is_finite(point.place.normal) &&
                       point.place.radius > 0 && glm::dot(point.place.normal, point.place.normal) > 0.5f;
        if (point.usable) draw_directions(range.seed, range.first + i, point);
    });
    return points;
}

void add_spawned(const Primitive& primitive, const Geometry& geometry, const Surface& surface,
                 const StressRange& range, std::span<const SpawnPoint> points, SpawnTally& tally) {
    const StrandLeaves leaves(geometry, range.count, range.family->curves);
    const std::vector<Surface> parts = strand_surfaces(surface, range.count, range.family->curves);
    std::vector<PointResult> results(points.size());
    parallel_for(points.size(), [&](size_t i) {
        if (points[i].usable)
            results[i] = spawn_all({primitive, geometry, leaves.of(i)}, points[i], parts[i]);
    });
    count_points(points, tally);
    for (const PointResult& result : results) {
        tally.self_hits += result.self_hits;
        tally.unmoved += result.unmoved;
        tally.own_hits += result.own_hits;
        tally.radii_needed = std::max(tally.radii_needed, result.radii_needed);
        tally.ulps_needed = std::max(tally.ulps_needed, result.ulps_needed);
    }
    const std::vector<Ray> rays = rays_of(points, primitive.spawn, 0);
    const CpuTracer tracer(geometry, primitive, Precision::single, extent_of(rays));
    std::vector<char> differs(rays.size());
    parallel_for(rays.size(), [&](size_t i) {
        differs[i] = tracer.trace(rays[i]).is_hit() != tracer.trace(rays[i], TraceMode::any).is_hit();
    });
    for (size_t i = 0; i < rays.size(); ++i) {
        tally.shadow_rays += points[i].usable;
        tally.shadow_differs += differs[i] != 0;
    }
}

void add_spawned(const PairScene& scene, const Primitive& primitive, const Surface& surface,
                 const StressRange& range, std::span<const SpawnPoint> points, SpawnTally& tally) {
    const std::vector<Surface> parts = strand_surfaces(surface, range.count, range.family->curves);
    count_points(points, tally);
    for (size_t k = 0; k < spawn_directions; ++k) {
        const std::vector<Ray> rays = rays_of(points, primitive.spawn, k);
        const std::vector<StressHit> closest = scene.trace(rays), shadow = scene.trace(rays, true);
        std::vector<char> wrong(rays.size());
        parallel_for(rays.size(), [&](size_t i) {
            if (!points[i].usable || !closest[i].is_hit()) return;
            const SpawnPlace& place = points[i].place;
            const double distance = primitive.spawn.distance(place.radius, place.size);
            wrong[i] = LazyOracle(parts[i]).refutes(points[i], k, distance, closest[i].t);
        });
        for (size_t i = 0; i < rays.size(); ++i) {
            if (!points[i].usable) continue;
            if (closest[i].is_hit()) ++(wrong[i] ? tally.self_hits : tally.own_hits);
            ++tally.shadow_rays;
            tally.shadow_differs += closest[i].is_hit() != shadow[i].is_hit();
        }
    }
}

}  // namespace strandlab
