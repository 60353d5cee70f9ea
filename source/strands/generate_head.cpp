// A head of hair: roots on the scalp of an ellipsoid, strands that hang and gather in locks.
#include "base/sine.h"
#include "strands/generator_parts.h"
#include "strands/rod.h"

namespace strandlab {
namespace {

constexpr size_t steps_per_curve = 4;

bool is_on_scalp(const glm::dvec3& u) { return u.y > -0.45 && u.y > 0.85 * u.z - 0.3; }

/// Hair falls away from a parting on top, a little backwards.
glm::dvec3 combing_direction(const glm::dvec3& u) {
    return {u.x + (u.x < 0 ? -0.25 : 0.25), -0.5, u.z - 0.35};
}

/// The parameters, looked up once.
struct HeadStyle {
    RodStyle own, guide;
    uint64_t seed;
    double lock_size, gathering, curl_radius, curl_period;
    bool is_curled;
    double depth;  // of a curl across its plane: 1 is a helix, 0 a plane wave

    explicit HeadStyle(const Parameters& parameters)
        : seed(parameters.integer("seed")),
          lock_size(parameters.number("lock_size")),
          gathering(parameters.number("gathering")),
          curl_radius(parameters.number("curl_radius")),
          curl_period(parameters.number("curl_period")),
          is_curled(!parameters.is("style", "straight")),
          depth(parameters.is("style", "curly") ? 1 : 0.15) {
        own.length = parameters.number("length");
        own.length_variation = parameters.number("length_variation");
        own.gravity = parameters.number("gravity");
        own.wander = parameters.number("wander");
        guide = own;
        guide.length_variation = 0;
    }
};

/// The curl of one strand: turns about its lock's guide, open at the root and closer towards the tip.
class Curl {
  public:
    Curl(const HeadStyle& style, Random& lock, Random& own) : depth_(style.depth) {
        radius_ = style.curl_radius * lock.range(0.7, 1.3) * (1 + 0.1 * own.signed_unit());
        period_ = style.curl_period * lock.range(0.9, 1.2) * (1 + 0.03 * own.signed_unit());
        phase_ = tau * lock.uniform() + 0.4 * own.signed_unit();
    }
    /// Moves on by ds at the fraction u of the length.
    void advance(double ds, double u) { phase_ += tau * ds / (period_ * (1 - 0.25 * u)); }

    glm::dvec3 offset(const RodStep& axis, double s) const {
        const SinCos angle = sin_cos(phase_);
        const double grown = radius_ > 0 ? radius_ * s / (s + 1.5 * radius_) : 0;
        return grown *
               (axis.normal * angle.cos + depth_ * angle.sin * glm::cross(axis.direction, axis.normal));
    }

  private:
    double radius_, period_, phase_, depth_;
};

/// A number for every cell of a grid on the unit sphere.
uint64_t cell_key(const glm::dvec3& index) {
    uint64_t key = 0;
    for (int i = 0; i < 3; ++i)
        key = (key << 20) | static_cast<uint64_t>(static_cast<int64_t>(index[i]) + (1 << 18));
    return key;
}

/// Grows strands one after the other; keeps the two paths' memory.
class HeadFiller {
  public:
    explicit HeadFiller(const HeadStyle& style) : style_(style) {}

    void operator()(size_t strand, std::span<glm::vec4> points) {
        Random random(style_.seed, 1, strand);
        glm::dvec3 u = random_direction(random);
        while (!is_on_scalp(u)) u = random_direction(random);
        const size_t steps = (points.size() - 1) * steps_per_curve;
        const double length = grow_rod(style_.own, random, u, combing_direction(u), steps, own_);

        // Roots in one cell share a guide, which is drawn from the cell's own numbers.
        const glm::dvec3 cell = glm::floor(u / style_.lock_size);
        Random lock(style_.seed, 2, cell_key(cell));
        const glm::dvec3 centre = glm::normalize(cell + 0.5);
        grow_rod(style_.guide, lock, centre, combing_direction(centre), steps, guide_);
        place(points, length, Curl(style_, lock, random));
    }

  private:
    /// Between the strand's own path and its guide's, closer to the guide towards the tip.
    void place(std::span<glm::vec4> points, double length, Curl curl) const {
        const size_t steps = own_.size() - 1;
        const double ds = length / double(steps);
        for (size_t i = 0; i <= steps; ++i) {
            if (i % steps_per_curve == 0) {
                const double s = double(i) * ds, k = style_.gathering * s / (s + 0.15 * length);
                glm::dvec3 p = (1 - k) * own_[i].position + k * guide_[i].position;
                if (style_.is_curled) p += curl.offset(guide_[i], s);
                points[i / steps_per_curve] = glm::vec4(glm::dvec4(p, 0));
            }
            curl.advance(ds, (double(i) + 0.5) / double(steps));
        }
    }

    const HeadStyle& style_;
    std::vector<RodStep> own_, guide_;
};

Curves make_head(const Parameters& parameters) {
    const HeadStyle style(parameters);
    return grow_strands(parameters, [&] { return HeadFiller(style); });
}

}  // namespace

Generator head_generator() {
    std::vector<ParameterInfo> parameters = common_parameters("10000", "32", "0.25", "0.12");
    parameters.push_back(
        {"style", "how the strands run", "straight", 0, 0, false, {"straight", "wavy", "curly"}});
    parameters.push_back({"gravity", "turning towards the ground, 1/m", "20", 0, 1000});
    parameters.push_back({"wander", "slow random turning, 1/m", "7", 0, 1000});
    parameters.push_back(
        {"lock_size", "size of the cells whose strands form a lock, of the head's radius", "0.2", 0.001, 1});
    parameters.push_back({"gathering", "how far a strand closes in on its lock, 0 to 1", "0.8", 0, 1});
    parameters.push_back({"curl_radius", "radius of curls or half the width of waves, m", "0.006", 0, 1});
    parameters.push_back({"curl_period", "length of a curl or a wave, m", "0.045", 1e-4, 10});
    return {"head", "a head of hair, straight, wavy or curly", parameters, make_head};
}

}  // namespace strandlab
