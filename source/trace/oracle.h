// The double-precision reference that arbitrates: the first hit of a ray with a Surface.
#pragma once

#include "scene/hits.h"
#include "scene/rays.h"
#include "scene/surface.h"
#include "trace/bvh.h"
#include "trace/oracle_frame.h"

#include <span>
#include <vector>

namespace strandlab {

/// A variation of the surface, and the arithmetic.
struct OracleOptions {
    /// All radii are multiplied by this (triangle vertices move away from or towards their centre line).
    double radius_scale = 1;
    /// When radius_scale is not 1, radii move by at least this many float ulps of the piece's largest
    /// coordinate relative to its first point.
    double radius_ulps = 0;
    /// Strand ends that are not round move outwards by this parameter amount (inwards when negative).
    double end_shift = 0;
    /// long double instead of double, to check the reference against itself; several times slower.
    bool extended = false;
};

/// Intersects a surface with rays. Roots are isolated in Bernstein form from control points that are
/// recomputed in a frame around each piece, so that the position error is about 1e-16 of the piece's size
/// whatever the distance of the ray.
///
/// Swept pieces count entering hits only. Each piece is closed by itself at interior joints; from outside
/// the union is seen. A ray that starts within a piece does not see that piece's current part of the
/// solid, and has starts_inside set whatever else it hits. Triangles are two-sided and their normal faces
/// the ray. Of hits with the same t the piece that comes first in the surface wins. Invalid rays miss. Where
/// a curve folds back on itself, a disc that makes half a turn within about 1e-6 of the parameter is not
/// resolved: whether there is such a turn hangs on the last bits of the control points.
class Oracle {
  public:
    /// Builds the hierarchy. Keeps a reference: the surface must outlive the oracle. The options are those
    /// of trace without options, and the largest variation that trace may be asked for.
    explicit Oracle(const Surface& surface, const OracleOptions& options = {});
    explicit Oracle(Surface&&, const OracleOptions& = {}) = delete;

    ReferenceHit trace(const Ray& ray) const { return trace(ray, options_); }
    /// With other options, whose surface must lie within that of the construction.
    ReferenceHit trace(const Ray& ray, const OracleOptions& options) const;
    /// The same; stays_clear: the ray's line meets no ball of any piece on its way and comes near no
    /// triangle, so that with smaller radii and the ends drawn in it misses whatever the surface is.
    ReferenceHit trace(const Ray& ray, const OracleOptions& options, bool& stays_clear) const;
    /// The same where it is known that no hit lies before ray parameter `from`: what lies there is left out.
    ReferenceHit trace(const Ray& ray, const OracleOptions& options, double from) const;
    /// All rays, in parallel.
    std::vector<ReferenceHit> trace(std::span<const Ray> rays) const;
    /// A ray in double precision; numbers must be finite, the direction not zero, 0 <= tmin <= tmax.
    ReferenceHit trace(const oracle::ExactRay& ray, const OracleOptions& options) const;

    const OracleOptions& options() const { return options_; }
    Box bounds() const { return bvh_.bounds(); }
    size_t leaf_count() const { return bvh_.item_count(); }

  private:
    /// A leaf: part of a piece, or a triangle when primitive >= number of pieces.
    struct Item {
        uint32_t primitive;
        uint16_t part, parts;
    };
    template <class Real>
    class Query;

    const Surface* surface_;
    OracleOptions options_;
    std::vector<Item> items_;
    Bvh bvh_;
};

}  // namespace strandlab
