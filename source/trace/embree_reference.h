// Embree as a second opinion: the same surface and the same rays through another renderer's code.
#pragma once

#include "scene/hits.h"
#include "scene/rays.h"
#include "scene/surface.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace strandlab {

/// Whether the program was built with Embree (CMake option STRANDLAB_EMBREE).
bool embree_available();

/// "3.13.5", or empty where it is not built in.
std::string embree_version();

/// What Embree's geometry says about a surface, and where that is the surface's own definition.
struct EmbreeDefinition {
    std::string_view geometry;  // one line: how Embree represents the surface
    std::string_view limits;    // one line: where it must not be taken for a verdict
    bool same_sweep = false;    // its definition of the side surface is the surface's own
    bool same_ends = false;     // and so are its strand ends
    /// Smallest radius, in lengths of a piece, for which its hits were found good (0: no such limit).
    double min_radius_ratio = 0;
};

/// Triangles are exact. Straight pieces become round linear curves: the surface's own round cones with
/// round ends, but computed with little precision. Cubic pieces become round Bezier curves: the swept
/// disc, open at its ends; of swept spheres that is the same side surface for a constant radius only.
EmbreeDefinition embree_definition(const Surface& surface);

/// A surface in Embree, built once and traced many times (robust mode). Throws Error (usage) where Embree
/// is not built in, Error (device_lost) when Embree reports an error.
///
/// - Straight pieces of a sphere sweep: RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE; consecutive pieces of a
///   strand that share a joint bit for bit share its vertex, so that Embree closes the joint. Cubic
///   pieces, and straight pieces of a disc sweep: RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE. Triangles:
///   RTC_GEOMETRY_TYPE_TRIANGLE.
/// - Embree's curves are two-sided and open tubes show their inner walls; here swept surfaces are
///   front-face only. A filter rejects hits of curves whose geometric normal does not face the ray, so
///   that both have one definition; triangles stay two-sided. A ray that starts inside a strand thus
///   leaves it unseen.
/// - Round Bezier: p99 of |dt| 2e-4 radii for radii from 1e-3 to 0.1 lengths of the piece near the world
///   origin, over 99.9 % agreement on clear hits and misses. Thinner (1e-4: 6 % false misses and 4 %
///   false hits; 1e-5: 40 %), or with the curve 1e4 lengths from the world origin (2 % and 6 %), it is no
///   reference, nor where the radius exceeds the radius of curvature. Ends are open.
/// - Round linear: p99 3e-2 radii at a hundredth of the length, 1 % misses at 1e-3, a third at 1e-4.
///   Rays within about 2e-4 radians of a piece's axis are missed (3.13). Ends are always round. Never the
///   judge of round cones; a gross disagreement is worth a look, no more.
/// - Rays that are invalid (is_valid) miss. Hits count for tmin <= t <= tmax.
class EmbreeScene {
  public:
    explicit EmbreeScene(const Surface& surface);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    /// The nearest hit of every ray (parallel): what a timing measures. hits: one for each ray.
    void trace(std::span<const Ray> rays, std::span<Hit> hits) const;

    /// The same with normals (unit; of triangles the side that faces the ray) and the surface's radius at
    /// the hit (of triangles the distance of the hit from its centre line), for comparisons. on_cap is
    /// set where a round end was met; starts_inside is not known and stays false.
    void trace(std::span<const Ray> rays, std::span<ReferenceHit> hits) const;

    /// Bytes that Embree holds for the scene and its tree.
    size_t bytes() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace strandlab
