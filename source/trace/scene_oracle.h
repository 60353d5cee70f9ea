// The reference for scenes of several placed surfaces.
#pragma once

#include "trace/oracle.h"

#include <glm/mat4x3.hpp>

#include <memory>
#include <span>
#include <vector>

namespace strandlab {

/// One placed surface. transform maps object space to world space (columns: axes and translation);
/// first_curve is added to the surface's curve numbers.
struct SurfaceInstance {
    uint32_t surface = 0;
    glm::mat4x3 transform{1.0f};
    uint32_t first_curve = 0;
};

/// First hit of a ray with any of the instances. The ray goes to object space in double precision, where t
/// is the same; normals come back by the inverse transpose; the radius is scaled by the cube root of the
/// transform's volume. starts_inside is set when the ray starts inside any instance.
class SceneOracle {
  public:
    /// Keeps references to the surfaces. Throws Error (bad_input) where a transform cannot be inverted or an
    /// instance names a surface that does not exist.
    SceneOracle(std::span<const Surface> surfaces, std::span<const SurfaceInstance> instances,
                const OracleOptions& options = {});

    ReferenceHit trace(const Ray& ray) const;
    std::vector<ReferenceHit> trace(std::span<const Ray> rays) const;

  private:
    struct Placed {
        const Oracle* oracle;
        glm::dmat3 inverse;  // world to object, linear part
        glm::dvec3 translation;
        double scale;
        uint32_t first_curve;
    };

    std::vector<std::unique_ptr<Oracle>> oracles_;
    std::vector<Placed> placed_;
    Bvh bvh_;
};

}  // namespace strandlab
