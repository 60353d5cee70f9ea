#include "primitives/strand_frames.h"

#include <cassert>
#include <cmath>

namespace strandlab {
namespace {

bool same_place(const glm::vec4& a, const glm::vec4& b) { return glm::vec3(a) == glm::vec3(b); }

/// Direction that a frame between two chords is normal to; each may be 0 (there is none).
glm::dvec3 tangent_between(const glm::dvec3& incoming, const glm::dvec3& outgoing) {
    const glm::dvec3 none(0);
    if (incoming == none && outgoing == none) return {0, 0, 1};  // the strand is one point
    const glm::dvec3 sum = incoming + outgoing;
    const bool turns_little = glm::dot(incoming, outgoing) >= -0.5;  // by 120 degrees or less
    return outgoing != none && (incoming == none || turns_little) ? glm::normalize(sum) : incoming;
}

/// Any frame normal to a unit tangent, turned by roll (basis of Duff et al. 2017).
StrandFrame first_frame(const glm::dvec3& t, double roll) {
    const double side = t.z >= 0 ? 1.0 : -1.0;
    const double a = -1 / (side + t.z), b = t.x * t.y * a;
    const glm::dvec3 x(1 + side * t.x * t.x * a, side * b, -side * t.x), y(b, side + t.y * t.y * a, -t.y);
    const double c = std::cos(roll), s = std::sin(roll);
    return {c * x + s * y, c * y - s * x};
}

glm::dvec3 reflected(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - (2 * glm::dot(normal, v) / glm::dot(normal, normal)) * normal;
}

/// Removes what rounding has added.
StrandFrame orthonormal(StrandFrame frame, const glm::dvec3& tangent) {
    frame.axis_0 = glm::normalize(frame.axis_0 - tangent * glm::dot(tangent, frame.axis_0));
    frame.axis_1 -= tangent * glm::dot(tangent, frame.axis_1);
    frame.axis_1 = glm::normalize(frame.axis_1 - frame.axis_0 * glm::dot(frame.axis_0, frame.axis_1));
    return frame;
}

}  // namespace

FrameCarrier::FrameCarrier(std::span<const glm::vec4> points, double roll) : points_(points), roll_(roll) {}

glm::dvec3 FrameCarrier::direction_onwards() {
    if (next_ <= point_) next_ = point_ + 1;
    while (next_ < points_.size() && same_place(points_[next_], points_[point_])) ++next_;
    if (next_ == points_.size()) return glm::dvec3(0);
    return glm::normalize(glm::dvec3(points_[next_]) - glm::dvec3(points_[point_]));
}

const StrandFrame& FrameCarrier::advance() {
    assert(point_ < points_.size());
    const bool repeated = point_ > 0 && same_place(points_[point_], points_[point_ - 1]);
    if (!repeated) {
        const glm::dvec3 outgoing = direction_onwards();
        const glm::dvec3 tangent = tangent_between(incoming_, outgoing);
        if (point_ == 0) {
            frame_ = first_frame(tangent, roll_);
            tangent_ = tangent;
        } else {
            // Both tangents are turned to within 60 degrees of the chord. Then the second mirror, their
            // difference after the first reflection, is at least 1 long.
            const glm::dvec3& chord = incoming_;
            const glm::dvec3 from = glm::dot(tangent_, chord) < 0 ? -tangent_ : tangent_;
            const glm::dvec3 to = glm::dot(tangent, chord) < 0 ? -tangent : tangent;
            const glm::dvec3 mirror = to - reflected(from, chord);
            frame_ = orthonormal({reflected(reflected(frame_.axis_0, chord), mirror),
                                  reflected(reflected(frame_.axis_1, chord), mirror)},
                                 to);
            tangent_ = to;
        }
        incoming_ = outgoing;
    }
    ++point_;
    return frame_;
}

}  // namespace strandlab
