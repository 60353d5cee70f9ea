#include "trace/oracle.h"

#include "base/parallel.h"
#include "strands/curves.h"
#include "trace/coherent_order.h"
#include "trace/disc_hit.h"
#include "trace/surface_variation.h"
#include "trace/swept_hit.h"
#include "trace/triangle_hit.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace strandlab {
namespace {

using namespace oracle;

/// A box that holds the piece's parameter interval [a, b], with everything rounded outwards.
Box part_box(const SurfacePiece& piece, double a, double b, const OracleOptions& options) {
    Curve curve = piece.control;
    if (piece.straight) {
        curve[1] = glm::vec4((2.0 * glm::dvec4(curve[0]) + glm::dvec4(curve[3])) / 3.0);
        curve[2] = glm::vec4((glm::dvec4(curve[0]) + 2.0 * glm::dvec4(curve[3])) / 3.0);
    }
    const std::array<double, 4> radii = varied_radii(piece, options);
    for (int i = 0; i < 4; ++i)
        curve[i].w = std::nextafter(static_cast<float>(radii[i]), std::numeric_limits<float>::infinity());
    return bounds_of(curve, a, b);
}

Box triangle_box(const SurfaceTriangle& triangle, const OracleOptions& options) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Box box;
    for (const glm::dvec3& vertex : varied_vertices(triangle, options)) box.add(glm::vec3(vertex));
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::nextafter(box.low[axis], -infinity);
        box.high[axis] = std::nextafter(box.high[axis], infinity);
    }
    return box;
}

/// Leaves for a piece: about as long as eight radii, and few where there are many pieces.
uint16_t part_count(const SurfacePiece& piece, uint32_t most) {
    double length = 0, radius = 0;
    for (int i = 0; i < 4; ++i) {
        if (piece.straight && (i == 1 || i == 2)) continue;
        radius = std::max(radius, double(piece.control[i].w));
        const int previous = piece.straight ? 0 : i - 1;
        if (i > 0) length += glm::length(glm::dvec3(piece.control[i]) - glm::dvec3(piece.control[previous]));
    }
    const double parts = length / (8 * radius);
    return static_cast<uint16_t>(parts >= most ? most
                                 : parts > 1   ? static_cast<uint32_t>(std::ceil(parts))
                                               : 1u);
}

/// A parameter of a whole curve: rounding, and ends that were shifted, can leave [0, 1].
double on_curve(double u) { return std::clamp(u, 0.0, 1.0); }

}  // namespace

Oracle::Oracle(const Surface& surface, const OracleOptions& options) : surface_(&surface), options_(options) {
    const size_t pieces = surface.pieces.size(), triangles = surface.triangles.size();
    assert(pieces + triangles < no_curve);
    const uint32_t most_parts = pieces > 4'000'000 ? 1 : pieces > 1'500'000 ? 2 : pieces > 100'000 ? 4 : 8;
    std::vector<size_t> first(pieces + 1, 0);
    parallel_for(pieces, [&](size_t i) { first[i + 1] = part_count(surface.pieces[i], most_parts); });
    for (size_t i = 0; i < pieces; ++i) first[i + 1] += first[i];
    items_.resize(first.back() + triangles);
    std::vector<Box> boxes(items_.size());
    parallel_for(pieces, [&](size_t i) {
        const SurfacePiece& piece = surface.pieces[i];
        const auto parts = static_cast<uint16_t>(first[i + 1] - first[i]);
        const ParameterRange range(piece, surface.caps, options);
        for (uint16_t k = 0; k < parts; ++k) {
            items_[first[i] + k] = {static_cast<uint32_t>(i), k, parts};
            const double a = k == 0 ? std::min(0.0, range.a) : double(k) / parts;
            const double b = k + 1 == parts ? std::max(1.0, range.b) : double(k + 1) / parts;
            boxes[first[i] + k] = part_box(piece, a, b, options);
        }
    });
    parallel_for(triangles, [&](size_t i) {
        items_[first.back() + i] = {static_cast<uint32_t>(pieces + i), 0, 1};
        boxes[first.back() + i] = triangle_box(surface.triangles[i], options);
    });
    bvh_ = Bvh(boxes);
}

/// One ray on its way through the hierarchy.
template <class Real>
class Oracle::Query {
  public:
    /// from: no hit lies before it.
    Query(const Oracle& oracle, const ExactRay& ray, const OracleOptions& options, double from = 0)
        : surface_(*oracle.surface_), items_(oracle.items_), ray_(ray), options_(options) {
        recent_.fill(no_curve);
        const BvhRay traversal(ray.origin, ray.direction, std::max(from, ray.tmin), ray.tmax);
        oracle.bvh_.traverse(traversal, [&](uint32_t item, double& tmax) {
            const Item& leaf = items_[item];
            if (leaf.primitive < surface_.pieces.size())
                visit_piece(leaf);
            else
                visit_triangle(leaf.primitive);
            if (best_.t < tmax) tmax = best_.t;
            return false;
        });
    }
    const ReferenceHit& result() const { return best_; }
    bool stays_clear() const { return stays_clear_; }

  private:
    /// Whether a hit at t replaces the best one so far.
    bool is_better(double t, uint32_t primitive) const {
        return t >= ray_.tmin && t <= ray_.tmax &&
               (!best_.is_hit() || t < best_.t || (t == best_.t && primitive < best_primitive_));
    }

    void visit_piece(const Item& leaf) {
        for (const uint32_t primitive : recent_)
            if (primitive == leaf.primitive) return;
        const SurfacePiece& piece = surface_.pieces[leaf.primitive];
        glm::dvec3 middle(0.5 * (glm::dvec3(piece.control[0]) + glm::dvec3(piece.control[3])));
        if (!piece.straight)
            middle = 0.5 * middle + 0.25 * (glm::dvec3(piece.control[1]) + glm::dvec3(piece.control[2]));
        const Frame<Real> frame(ray_, glm::dvec3(piece.control[0]), middle);
        const ParameterRange range(piece, surface_.caps, options_);
        const Swept<Real> s = swept_piece(frame, piece, range, options_);
        const Real a = leaf.part == 0 ? Real(0) : Real(range.local(double(leaf.part) / leaf.parts));
        const Real b =
            leaf.part + 1 == leaf.parts ? Real(1) : Real(range.local(double(leaf.part + 1) / leaf.parts));
        if (misses(s, a, b)) return;
        stays_clear_ = false;
        // Whatever part of the piece the ray came through, the piece is examined as a whole, once.
        recent_[next_recent_] = leaf.primitive;
        next_recent_ = (next_recent_ + 1) % recent_.size();
        const PieceEnds ends{surface_.caps, piece.begins_strand, piece.ends_strand, piece.straight};
        const Real z_min = frame.depth(ray_.tmin);
        const SweptResult<Real> found =
            surface_.sweep == Surface::Sweep::disc ? hit_discs(s, ends, z_min) : hit_spheres(s, ends, z_min);
        if (found.starts_inside) best_.starts_inside = true;
        if (found.found) take(frame, piece, range, found.hit, leaf.primitive);
    }

    void take(const Frame<Real>& frame, const SurfacePiece& piece, const ParameterRange& range,
              const SweptHit<Real>& hit, uint32_t primitive) {
        const auto t = static_cast<double>(frame.parameter(hit.z));
        if (!is_better(t, primitive)) return;
        best_.t = t;
        const double u = range.global(static_cast<double>(hit.u));
        best_.u = on_curve(piece.u0 + (double(piece.u1) - double(piece.u0)) * u);
        best_.normal = unit_or_facing(frame.global(hit.normal.x, hit.normal.y, hit.normal.z));
        best_.radius = static_cast<double>(hit.radius);
        best_.curve = piece.curve;
        best_.on_cap = hit.on_cap;
        best_primitive_ = primitive;
    }

    /// Unit; against the ray where a vanishing radius leaves no direction, or an overflow.
    glm::dvec3 unit_or_facing(const glm::dvec3& normal) const {
        const auto unit = [](const glm::dvec3& v) {
            return glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}));
        };
        const glm::dvec3 own = unit(normal);
        return std::abs(glm::length(own) - 1) < 0.5 ? own : -unit(ray_.direction);
    }

    void visit_triangle(uint32_t primitive) {
        stays_clear_ = false;
        const SurfaceTriangle& triangle = surface_.triangles[primitive - surface_.pieces.size()];
        const std::array<glm::dvec3, 3> vertices = varied_vertices(triangle, options_);
        const Frame<Real> frame(ray_, vertices[0], (vertices[0] + vertices[1] + vertices[2]) / 3.0);
        std::array<glm::vec<3, Real>, 3> local;
        for (int i = 0; i < 3; ++i) local[i] = frame.local(vertices[i]);
        TriangleHit<Real> hit;
        if (!hit_triangle(local, hit)) return;
        const auto t = static_cast<double>(frame.parameter(hit.z));
        if (!is_better(t, primitive)) return;
        glm::dvec3 normal = glm::cross(vertices[1] - vertices[0], vertices[2] - vertices[0]);
        if (glm::dot(normal, ray_.direction) > 0) normal = -normal;
        best_.t = t;
        best_.u = 0;
        best_.radius = 0;
        for (int i = 0; i < 3; ++i) {
            const auto weight = static_cast<double>(hit.weights[i]);
            best_.u += weight * double(triangle.u[i]);
            best_.radius += weight * glm::length(vertices[i] - glm::dvec3(triangle.centre[i]));
        }
        best_.u = on_curve(best_.u);
        best_.radius = std::max(best_.radius, 0.0);  // beside an edge by a rounding error
        best_.normal = unit_or_facing(normal);
        best_.curve = triangle.curve;
        best_.on_cap = false;
        best_primitive_ = primitive;
    }

    const Surface& surface_;
    const std::vector<Item>& items_;
    const ExactRay& ray_;
    const OracleOptions& options_;
    std::array<uint32_t, 8> recent_;
    size_t next_recent_ = 0;
    bool stays_clear_ = true;
    ReferenceHit best_;
    uint32_t best_primitive_ = no_curve;
};

ReferenceHit Oracle::trace(const ExactRay& ray, const OracleOptions& options) const {
    return options.extended ? Query<long double>(*this, ray, options).result()
                            : Query<double>(*this, ray, options).result();
}

namespace {

ExactRay exact(const Ray& ray) {
    return {glm::dvec3(ray.origin), glm::dvec3(ray.direction), ray.tmin, ray.tmax};
}

}  // namespace

ReferenceHit Oracle::trace(const Ray& ray, const OracleOptions& options) const {
    return is_valid(ray) ? trace(exact(ray), options) : ReferenceHit{};
}

ReferenceHit Oracle::trace(const Ray& ray, const OracleOptions& options, double from) const {
    if (!is_valid(ray)) return {};
    const ExactRay exact_ray = exact(ray);
    return options.extended ? Query<long double>(*this, exact_ray, options, from).result()
                            : Query<double>(*this, exact_ray, options, from).result();
}

ReferenceHit Oracle::trace(const Ray& ray, const OracleOptions& options, bool& stays_clear) const {
    stays_clear = true;
    if (!is_valid(ray)) return {};
    const ExactRay exact_ray = exact(ray);
    const auto ask = [&](const auto& query) {
        stays_clear = query.stays_clear();
        return query.result();
    };
    return options.extended ? ask(Query<long double>(*this, exact_ray, options))
                            : ask(Query<double>(*this, exact_ray, options));
}

std::vector<ReferenceHit> Oracle::trace(std::span<const Ray> rays) const {
    std::vector<ReferenceHit> hits(rays.size());
    const std::vector<uint32_t> order = coherent_order(rays);
    parallel_for(rays.size(), [&](size_t i) { hits[order[i]] = trace(rays[order[i]]); });
    return hits;
}

}  // namespace strandlab
