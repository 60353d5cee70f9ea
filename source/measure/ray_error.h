// The error of one ray: its outcome and, where the same place was hit, by how much it is off.
#pragma once

#include "base/float_ulp.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace strandlab {

/// What became of a ray; the classes are never averaged together.
enum class Outcome : uint8_t {
    agreed_miss,   // neither hits
    match,         // same strand of the same instance, same place
    nan,           // the trace returned a t or u that is not finite
    false_hit,     // the reference misses
    false_miss,    // the reference hits
    wrong_strand,  // another strand or instance, or a curve that does not exist
    wrong_place,   // same strand, but |dt| |direction| > max(radius / 2, 8 ulp of t)
};

/// What is measured of a match.
enum class Measure : uint8_t { distance, ulps, residual, strand_u, offset, normal, tangent };

struct MeasureInfo {
    std::string_view name;  // as in result files
    std::string_view unit;
    std::string_view help;
};

/// Descriptions, indexed by Measure.
inline constexpr std::array measure_infos{
    MeasureInfo{"distance", "radius", "|t - reference t| |direction| / radius"},
    MeasureInfo{"ulps", "ulp", "|t - reference t| in units of the float spacing at the reference t"},
    MeasureInfo{"residual", "radius",
                "distance of the hit point from the surface at its own u, ||p - C(u)| - r| / r"},
    MeasureInfo{"strand_u", "curve", "|u - reference u|, u counted along the strand: 1 is one curve"},
    MeasureInfo{"offset", "radius", "|h - reference h|, h the signed offset across the width, -1 to 1"},
    MeasureInfo{"normal", "degree", "angle between the normals"},
    MeasureInfo{"tangent", "degree", "angle between the curve tangents at u and at the reference u"},
};
inline constexpr size_t measure_count = measure_infos.size();

/// What is compared. Spans have one entry per ray unless said otherwise; they must outlive the call.
struct ComparisonInput {
    std::span<const Ray> rays;
    std::span<const Hit> hits;
    std::span<const glm::vec3> normals = {};  // empty: the trace returned none
    std::span<const ReferenceHit> reference;
    std::span<const uint8_t> decisive = {};  // 0: undecided; empty: all rays are decisive
    /// 0: the place of the hit is undecided, though hit or miss and the strand may be decisive; empty: the
    /// place of every decisive ray is.
    std::span<const uint8_t> decisive_place = {};
    /// Not 0: the ray starts inside the surface that was traced; empty: none does. The reference knows only
    /// of its own surface.
    std::span<const uint8_t> inside_own = {};
    double margin = 0;               // the d that decisive was found with
    const Curves* curves = nullptr;  // strands for identity and u; centre lines for h and tangents

    /// Transforms of the instances that hits name; empty: one instance, not moved. u, h and
    /// tangents are compared in object space, where the curves are.
    std::span<const glm::mat4x3> world_from_object = {};

    /// Measure the residual against the sweep of the curves themselves (the common reference).
    bool residual_of_curves = false;
    /// Otherwise: residual of the hit of a ray, in radii, from whoever knows the surface; NaN: not
    /// measured. Called for matches only, from many threads; empty: no residuals.
    std::function<double(size_t ray)> residual = {};

    bool hit_or_miss_only = false;  // shadow rays: t, u and curve of a hit mean nothing
    bool knows_curves = true;       // false (voxels): strands are not compared, nor what needs u
};

/// Error of one ray. A measure that does not apply is NaN.
struct RayError {
    std::array<float, measure_count> measures;
    Outcome outcome = Outcome::agreed_miss;
    bool bad_normal = false;  // of a match: not finite, or zero
};

/// Finds the errors of single rays; made once per comparison.
class RayErrors {
  public:
    /// Asserts that the spans fit together.
    explicit RayErrors(const ComparisonInput& input);

    RayError of(size_t ray) const;

  private:
    Outcome outcome_of(const Ray& ray, const Hit& hit, const ReferenceHit& reference) const;
    void measure_distance(const Ray& ray, const Hit& hit, const ReferenceHit& reference,
                          RayError& error) const;
    void measure_curve(const Ray& ray, const Hit& hit, const ReferenceHit& reference, RayError& error) const;
    void measure_normal(const glm::vec3& normal, const ReferenceHit& reference, RayError& error) const;

    const ComparisonInput& input_;
    std::vector<glm::dmat4> object_from_world_;
};

/// Angle in degrees between two vectors of any length, accurate for small angles; NaN when one is zero or
/// not finite.
double angle_between(const glm::dvec3& a, const glm::dvec3& b);

/// ||p - C(u)| - r(u)| / r(u): how far a point is from the sphere of the curve's sweep that its u names, in
/// radii. NaN when the radius is 0. Unlike |dt| it stays small where a ray only grazes the surface.
double sweep_residual(const Curve& curve, double u, const glm::dvec3& point);

/// Signed offset of a ray across the width of the curve at u, in radii: distance of the lines through the
/// ray and along the tangent, positive on the side of direction x tangent. NaN where the ray runs along
/// the curve or the radius is 0.
double width_offset(const Curve& curve, double u, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace strandlab
