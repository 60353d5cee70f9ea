// Which strands of a model rays may meet, by the cells of a grid that they pass.
#pragma once

#include "scene/bounds.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strandlab {

/// The box of the curves' control points, each with its radius: by the convex hull property of Bezier curves
/// it holds their swept spheres. It is exact up to the rounding of one addition. width: the radii are
/// multiplied by this.
Box hull_box(std::span<const Curve> curves, float width = 1);

/// Radii within which of its curve every primitive stays; strips of triangles may be wider than the strand.
inline constexpr float widest_primitive = 2;

/// Rays mark the cells that they pass; a strand is met when a box of one of its curves touches a marked cell.
/// Neighbouring rays are marked together, as beams: of lines the largest coordinate at each place is convex
/// along them, so that a beam between two planes lies below the chord of what it is at these, and above that
/// of the smallest.
class ReachGrid {
  public:
    /// What of a ray lies in the grid, in units of cells: a line, and where along its main axis.
    struct Segment {
        glm::dvec3 origin, slope;  // of the point with coordinate x along the axis: origin + slope x
        int axis = 0;
        double from = 0, to = 0;

        glm::dvec3 at(double x) const { return origin + slope * x; }
    };

    /// Every curve's box, as wide as any primitive, is enlarged on all sides by reach_margin times the
    /// largest coordinate of the model, and margin.
    ReachGrid(const Curves& curves, double reach_margin, double margin);

    /// Enlarged as the boxes are; empty for a model without curves.
    const Box& bounds() const { return bounds_; }

    /// In the model's space; nothing where the ray passes the grid by between tmin and tmax.
    std::optional<Segment> clip(const glm::dvec3& origin, const glm::dvec3& direction, double tmin,
                                double tmax) const;
    /// Marks at least the cells that the segments pass: those that lie close together as one. Any number of
    /// threads at a time.
    void mark(std::span<const Segment> segments);
    void mark_all();

    /// 1 for each strand of the curves that may be met.
    std::vector<uint8_t> strands_met(const Curves& curves) const;

  private:
    struct Beam;

    Box enlarged(const Box& box) const { return {box.low - margin_, box.high + margin_}; }
    static Box box_of(const Curve& curve) { return hull_box({&curve, 1}, widest_primitive); }
    size_t index_of(const glm::ivec3& cell) const {
        return (size_t(cell.z) * size_t(size_.y) + size_t(cell.y)) * size_t(size_.x) + size_t(cell.x);
    }
    void mark(const Beam& beam);
    void mark_cells(const glm::ivec3& low, const glm::ivec3& high);
    /// Number of marked cells below and left of each corner.
    std::vector<uint32_t> sums() const;
    bool touches_mark(const Box& box, const std::vector<uint32_t>& sums) const;

    Box bounds_;
    float margin_ = 0;
    double cell_ = 1;  // length of a side
    glm::ivec3 size_{1};
    bool all_met_ = false;
    std::vector<std::atomic<uint8_t>> cells_;
};

}  // namespace strandlab
