#include "primitives/dots_kernel.h"

#include "primitives/dots.h"
#include "primitives/kernel.h"

#include <algorithm>
#include <cstring>

namespace strandlab {
namespace kernels {

template <class real>
struct DotsKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/shared/ray_frame.h"
#include "shaders/shared/triangle.h"
#include "shaders/primitives/dots.h"
};

}  // namespace kernels

namespace {

/// What a ray meets on a triangle: the depth t and the barycentrics of the second and third vertex.
template <class Real>
struct TriangleHit {
    Real t;
    glm::vec<2, Real> barycentrics;
};

/// The four triangles of a piece have one frame, so that no ray slips between them.
template <class Real>
bool meet(const Geometry& geometry, size_t index, const Ray& ray, TriangleHit<Real>& hit) {
    using Kernel = kernels::DotsKernel<Real>;
    using Vector = glm::vec<3, Real>;
    const glm::uvec3 corners = geometry.triangles[index];
    const uint32_t start = std::min({corners.x, corners.y, corners.z}) & ~3u, end = start + 4;
    const Vector reference(geometry.vertices[start]), far(geometry.vertices[end]);
    const auto frame = Kernel::make_ray_frame(Vector(ray.origin), Vector(ray.direction), reference,
                                              (far - reference) * Real(0.5));
    const auto corner = [&](uint32_t vertex) {
        return Kernel::to_frame(frame, Vector(geometry.vertices[vertex]));
    };
    Real z;
    if (!Kernel::triangle_entry(corner(corners.x), corner(corners.y), corner(corners.z), z, hit.barycentrics))
        return false;
    hit.t = Kernel::ray_parameter(frame, z);
    return true;
}

template <class Real>
typename kernels::DotsKernel<Real>::DotsJoint joint_at(const Geometry& geometry, uint32_t index) {
    DotsJointRecord record;
    std::memcpy(&record, geometry.shading_records.bytes.data() + size_t(index) * sizeof record,
                sizeof record);
    return kernels::DotsKernel<Real>::dots_joint(glm::vec<4, Real>(record.place),
                                                 glm::vec<4, Real>(record.rotation));
}

/// What the closest-hit shader writes for a hit; round_offset: with the hit moved to the round strand.
template <class Real>
void shade(const Geometry& geometry, size_t index, const Ray& ray, const TriangleHit<Real>& met,
           bool round_offset, LeafHit<Real>& hit) {
    using Kernel = kernels::DotsKernel<Real>;
    const Leaf leaf = geometry.leaves[index];
    const uint32_t quad = (leaf.flags() & dots_quad_bit) != 0,
                   triangle = (leaf.flags() & dots_triangle_bit) != 0;
    const uint32_t start = dots_first_joint(geometry, leaf);
    const uint32_t width_bits = geometry.constant(dots_width_factor);
    float width_factor;
    std::memcpy(&width_factor, &width_bits, sizeof width_factor);
    hit.t = met.t;
    Real along = Kernel::dots_along(met.barycentrics, triangle);
    Kernel::dots_finish(glm::vec<3, Real>(ray.direction), Real(ray.tmin), joint_at<Real>(geometry, start),
                        joint_at<Real>(geometry, start + 1), quad, triangle, met.barycentrics,
                        Real(width_factor), geometry.constant(dots_round_normals) != 0, round_offset, hit.t,
                        along, hit.normal);
    hit.u = (Real(leaf.piece()) + along) / Real(leaf.pieces());
}

template <class Real>
bool intersect(const Geometry& geometry, size_t index, const Ray& ray, Real tmax, LeafHit<Real>& hit) {
    TriangleHit<Real> met;
    if (!meet(geometry, index, ray, met) || !(met.t >= Real(ray.tmin) && met.t < tmax)) return false;
    shade(geometry, index, ray, met, false, hit);
    return true;
}

template <class Real>
void finish(const Geometry& geometry, size_t index, const Ray& ray, LeafHit<Real>& hit) {
    TriangleHit<Real> met;
    if (geometry.constant(dots_round_offset) == 0 || !meet(geometry, index, ray, met)) return;
    shade(geometry, index, ray, met, true, hit);
}

}  // namespace

uint32_t dots_first_joint(const Geometry& geometry, Leaf leaf) {
    uint32_t first;
    std::memcpy(&first, geometry.shading_records.bytes.data() + size_t(leaf.curve) * sizeof first,
                sizeof first);
    return first + leaf.piece();
}

CpuIntersectors dots_cpu() { return {intersect<float>, intersect<double>, finish<float>, finish<double>}; }

}  // namespace strandlab
