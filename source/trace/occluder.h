// An opaque body among the hair: rays end where they meet it.
#pragma once

#include "scene/obj_file.h"
#include "scene/rays.h"
#include "trace/bvh.h"

#include <glm/glm.hpp>

#include <optional>
#include <span>
#include <vector>

namespace strandlab {

/// Triangles that stop rays. Every primitive and every reference gets rays that have been cut short, so that
/// all see the same body without knowing of it.
class Occluder {
  public:
    explicit Occluder(std::span<const Triangle> triangles);

    struct Meeting {
        double t = 0;
        glm::dvec3 normal{0};  // unit, towards the ray's origin, smooth over triangles that share corners
    };

    /// The nearest triangle within [tmin, tmax].
    std::optional<Meeting> meet(const Ray& ray) const;

    /// Lowers tmax of every ray to where it meets the body.
    void cut(std::vector<Ray>& rays) const;

  private:
    std::vector<Triangle> triangles_;
    std::vector<std::array<glm::dvec3, 3>> normals_;  // at the corners
    Bvh bvh_;
};

}  // namespace strandlab
