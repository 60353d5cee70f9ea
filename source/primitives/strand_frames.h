// Frames across a polyline that do not twist: what strips along a strand are built from.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace strandlab {

/// Two orthonormal axes across a strand.
struct StrandFrame {
    glm::dvec3 axis_0{1, 0, 0}, axis_1{0, 1, 0};
};

/// Carries a frame along the points of one strand by double reflection (Wang, Juettler, Zheng and Liu
/// 2008, "Computation of rotation minimizing frames"), in double. The frame at a point stands normal to
/// the polyline's tangent there: the bisector of the directions to its neighbours, or the incoming
/// direction where the polyline turns by more than 120 degrees, so that an axis keeps at least half its
/// length across each of the two chords. Repeated points share one frame; both reflections stay
/// well-conditioned at every turn, exact reversals included.
class FrameCarrier {
  public:
    /// points: (x, y, z, radius); must outlive the carrier. roll: angle (radians) of the first frame
    /// about the strand.
    FrameCarrier(std::span<const glm::vec4> points, double roll);

    /// The frame at the next point; called once for each point, in order.
    const StrandFrame& advance();

    /// Tangent that the last frame is normal to; its sign is of no meaning.
    const glm::dvec3& tangent() const { return tangent_; }

  private:
    glm::dvec3 direction_onwards();

    std::span<const glm::vec4> points_;
    double roll_;
    size_t point_ = 0;  // the one that advance comes to next
    size_t next_ = 0;   // first point beyond it that lies elsewhere
    glm::dvec3 incoming_{0}, tangent_{0};
    StrandFrame frame_;
};

}  // namespace strandlab
