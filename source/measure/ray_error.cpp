#include "measure/ray_error.h"

#include "strands/bezier.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

float& value_of(RayError& error, Measure measure) { return error.measures[static_cast<size_t>(measure)]; }

void set(RayError& error, Measure measure, double value) {
    value_of(error, measure) = static_cast<float>(value);
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A distance in units of size; 0 of 0 is no error.
double relative(double distance, double size) { return distance == 0 ? 0.0 : distance / size; }

}  // namespace

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const double sine = glm::length(glm::cross(a, b)), cosine = glm::dot(a, b);
    // Both are 0 exactly when a vector is zero: no angle.
    if (sine == 0 && cosine == 0) return undefined;
    return std::atan2(sine, cosine) * (180.0 / 3.14159265358979323846);
}

double sweep_residual(const Curve& curve, double u, const glm::dvec3& point) {
    const glm::dvec4 centre = point_at(to_double(curve), u);
    if (!(centre.w > 0)) return undefined;
    return std::abs(glm::distance(point, glm::dvec3(centre)) - centre.w) / centre.w;
}

double width_offset(const Curve& curve, double u, const glm::dvec3& origin, const glm::dvec3& direction) {
    const CurveD control = to_double(curve);
    const glm::dvec4 centre = point_at(control, u);
    const glm::dvec3 side = glm::cross(direction, tangent_at(control, u));
    const double length = glm::length(side);
    // Below this angle (in radians) the side is rounding noise.
    if (!(centre.w > 0) || !(length > 1e-6 * glm::length(direction))) return undefined;
    return glm::dot(origin - glm::dvec3(centre), side) / (length * centre.w);
}

RayErrors::RayErrors(const ComparisonInput& input) : input_(input) {
    assert(input.hits.size() == input.rays.size());
    assert(input.reference.size() == input.rays.size());
    assert(input.normals.empty() || input.normals.size() == input.rays.size());
    assert(input.decisive.empty() || input.decisive.size() == input.rays.size());
    assert(input.decisive_place.empty() || input.decisive_place.size() == input.rays.size());
    assert(input.inside_own.empty() || input.inside_own.size() == input.rays.size());
    assert(input.curves != nullptr || input.hit_or_miss_only || !input.knows_curves);
    for (const glm::mat4x3& transform : input.world_from_object)
        object_from_world_.push_back(glm::inverse(glm::dmat4(glm::mat4(transform))));
}

RayError RayErrors::of(size_t ray) const {
    const Ray& r = input_.rays[ray];
    const Hit& hit = input_.hits[ray];
    const ReferenceHit& reference = input_.reference[ray];
    RayError error;
    error.measures.fill(std::numeric_limits<float>::quiet_NaN());
    error.outcome = outcome_of(r, hit, reference);
    if (error.outcome != Outcome::match || input_.hit_or_miss_only) return error;
    measure_distance(r, hit, reference, error);
    if (input_.knows_curves) measure_curve(r, hit, reference, error);
    if (input_.residual) set(error, Measure::residual, input_.residual(ray));
    if (!input_.normals.empty()) measure_normal(input_.normals[ray], reference, error);
    return error;
}

Outcome RayErrors::outcome_of(const Ray& ray, const Hit& hit, const ReferenceHit& reference) const {
    if (!input_.hit_or_miss_only) {
        const bool finite = hit.is_hit() ? std::isfinite(hit.t) && std::isfinite(hit.u) : !std::isnan(hit.t);
        if (!finite) return Outcome::nan;
    }
    if (hit.is_hit() != reference.is_hit()) return hit.is_hit() ? Outcome::false_hit : Outcome::false_miss;
    if (!hit.is_hit()) return Outcome::agreed_miss;
    if (input_.hit_or_miss_only) return Outcome::match;

    if (input_.knows_curves) {
        if (hit.instance != reference.instance || hit.curve >= input_.curves->curves.size())
            return Outcome::wrong_strand;
        if (hit.curve != reference.curve &&
            input_.curves->strand_of(hit.curve) != input_.curves->strand_of(reference.curve))
            return Outcome::wrong_strand;
    }
    const double speed = glm::length(glm::dvec3(ray.direction));
    const double distance = std::abs(static_cast<double>(hit.t) - reference.t) * speed;
    const double allowed = std::max(reference.radius / 2, 8 * float_ulp(reference.t) * speed);
    return distance <= allowed ? Outcome::match : Outcome::wrong_place;
}

void RayErrors::measure_distance(const Ray& ray, const Hit& hit, const ReferenceHit& reference,
                                 RayError& error) const {
    const double dt = std::abs(static_cast<double>(hit.t) - reference.t);
    set(error, Measure::distance, relative(dt * glm::length(glm::dvec3(ray.direction)), reference.radius));
    set(error, Measure::ulps, dt / float_ulp(reference.t));
}

void RayErrors::measure_curve(const Ray& ray, const Hit& hit, const ReferenceHit& reference,
                              RayError& error) const {
    const double u = static_cast<double>(hit.u);
    // Curves of a strand are consecutive, so that the end of one and the start of the next are the same u.
    const double curves_apart = static_cast<double>(hit.curve) - static_cast<double>(reference.curve);
    set(error, Measure::strand_u, std::abs(curves_apart + (u - reference.u)));

    glm::dvec3 origin(ray.origin), direction(ray.direction);
    if (!object_from_world_.empty()) {
        assert(hit.instance < object_from_world_.size());
        const glm::dmat4& from_world = object_from_world_[hit.instance];
        origin = glm::dvec3(from_world * glm::dvec4(origin, 1));
        direction = glm::dvec3(from_world * glm::dvec4(direction, 0));
    }
    const Curve& curve = input_.curves->curves[hit.curve];
    const Curve& reference_curve = input_.curves->curves[reference.curve];
    set(error, Measure::offset,
        std::abs(width_offset(curve, u, origin, direction) -
                 width_offset(reference_curve, reference.u, origin, direction)));
    set(error, Measure::tangent,
        angle_between(tangent_at(to_double(curve), u), tangent_at(to_double(reference_curve), reference.u)));
    if (input_.residual_of_curves)
        set(error, Measure::residual,
            sweep_residual(curve, u, origin + static_cast<double>(hit.t) * direction));
}

void RayErrors::measure_normal(const glm::vec3& normal, const ReferenceHit& reference,
                               RayError& error) const {
    const glm::dvec3 n(normal);
    error.bad_normal = !is_finite(n) || n == glm::dvec3(0);
    if (!error.bad_normal) set(error, Measure::normal, angle_between(n, reference.normal));
}

}  // namespace strandlab
