// Intersectors on families of pairs: each ray meets its own strand alone, and the oracle of the
// intersector's own surface says what is right.
#pragma once

#include "measure/iteration_histogram.h"
#include "measure/log_histogram.h"
#include "measure/stress_families.h"
#include "primitives/primitive.h"
#include "scene/hits.h"
#include "scene/surface.h"
#include "trace/cpu_trace.h"
#include "trace/gpu_scene.h"

#include <cstdint>
#include <vector>

namespace strandlab {

/// Which pairs of a family: numbers first to first + count - 1 of a seed.
struct StressRange {
    const StressFamily* family = nullptr;
    uint64_t seed = default_stress_seed, first = 0, count = 0;
};

/// The strands of the pairs: strand i of `curves` is that of pair first + i and has family->curves curves.
Curves stress_strands(const StressRange& range);

/// Discs whose radius times curvature exceeds this overlap, or nearly so: sheets of the surface fold over
/// each other, and an iteration along the curve (PRHI) may settle on none or on a hidden one.
inline constexpr double most_bend = 0.7;

/// The right answer for one pair.
struct StressAnswer {
    double t = 0, radius = 0;
    double margin = 0;  // d: the relative change of radii that a decisive answer survives
    bool is_hit = false;
    bool decisive = false;        // hit or miss is the same for radii scaled by 1 +- d
    bool decisive_place = false;  // and the hit moves by less than 0.3 radii
    bool folded = false;          // a hit of swept discs where they overlap: radius x curvature >= most_bend
};

/// Pairs whose rays are aimed at one surface, with the oracle's answers.
struct StressPairs {
    StressRange range;
    std::vector<Ray> rays;
    std::vector<StressAnswer> answers;
};

/// Rays aimed at the surface (of the strands of the range), without answers.
StressPairs aimed_pairs(const StressRange& range, const Surface& surface);

/// Aims the rays at the surface (of the strands of the range), and asks the oracle. A ray is decisive when
/// the answer is the same for radii scaled by 1 +- d, d = max(1e-3, 8 ulp(largest coordinate of the piece
/// relative to its first point) / radius), open ends moved by 1e-3 of the piece (those of discs at a kink are
/// open too: they leave a wedge), and the ray's interval shortened and lengthened by 8 ulp. Where the radius
/// vanishes nothing is decisive.
StressPairs stress_pairs(const StressRange& range, const Surface& surface);

/// What an intersector said of one pair. curve: index among the curves of the range.
struct StressHit {
    double t = 0, u = 0;
    uint32_t curve = no_curve;

    bool is_hit() const { return curve != no_curve; }
};

/// Strand after strand through Embree's curves (a scene each), which decide by their own definition. Surface:
/// that of the pairs. Where Embree is not built in: Error (usage).
std::vector<StressHit> trace_pairs_with_embree(const Surface& surface, const StressPairs& pairs);

/// The piece of a curve that u belongs to, or is nearest to; none without pieces.
const SurfacePiece* piece_at(const Surface& surface, uint32_t curve, double u);

/// The surface cut into the parts of single strands of so many curves each.
std::vector<Surface> strand_surfaces(const Surface& surface, uint64_t strands, uint32_t curves);

/// Hits that a box had to let through, and those that it lost.
struct BoxCheck {
    uint64_t trials = 0;
    uint64_t lost = 0;     // by a slab test in float without any margin of its own
    uint64_t outside = 0;  // whose point origin + t direction, in extended precision, is not in the box

    void add(const BoxCheck& other) {
        trials += other.trials;
        lost += other.lost;
        outside += other.outside;
    }
};

/// The C++ version alone, leaf after leaf, without any box. boxes counts leaf hits, and those that their
/// padded box would lose, with the padding of a builder that knows the farthest origin.
std::vector<StressHit> intersect_pairs(const Primitive& primitive, const Geometry& geometry,
                                       const StressPairs& pairs, Precision precision, BoxCheck& boxes);

/// Iterations of the C++ float version, summed over the leaves of the ray's strand, for every valid ray;
/// nothing for closed forms.
void count_iterations(const Primitive& primitive, const Geometry& geometry, const StressPairs& pairs,
                      IterationHistogram& iterations);

/// How pairs are traced on a device.
struct PairTracing {
    float extent = 0;  // largest coordinate of any origin
    PipelineStore* pipelines = nullptr;
    Arithmetic arithmetic;              // of the device
    std::vector<std::string> no_skips;  // trace/skips.h
};

/// Pairs on a Vulkan device: a hundred strands or so share a structure, and every ray meets its own strand
/// only. What the C++ version finds and this does not was lost by a box, or by the arithmetic of the device.
class PairScene {
  public:
    PairScene(const Device& device, const Primitive& primitive, Geometry geometry, const StressRange& range,
              const PairTracing& how);

    /// One ray for each pair, in order; shadow: hits say only whether there is one.
    std::vector<StressHit> trace(std::span<const Ray> rays, bool shadow = false) const;

  private:
    GpuScene scene_;
};

/// A pair to look at, and how wrong it is: radii of a wrong place; 1e6 for hit or miss, 1e9 for NaN.
struct WorstPair {
    double error = 0;
    uint64_t index = 0;
    Ray ray;
};

/// How a device's hits differ from those of the C++ float version of the same text.
struct Agreement {
    uint64_t pairs = 0, both_hit = 0, only_device = 0, only_cpu = 0;
    LogHistogram ulps;     // |dt| in spacings of floats at t
    LogHistogram radii;    // |dt| |direction| / r
    LogHistogram allowed;  // |dt| / max(4 ulp(t), 1e-4 r / |direction|)

    /// Pairs that differ by more than is allowed, or in hit or miss.
    uint64_t beyond() const { return only_device + only_cpu + allowed.count_above(1); }
    uint64_t hits() const { return both_hit + only_device + only_cpu; }
};

/// Sums over the pairs of one family, primitive and device.
struct StressTally {
    uint64_t pairs = 0;
    uint64_t hits = 0, misses = 0;  // decisive, by the oracle
    uint64_t false_misses = 0, false_hits = 0, wrong_hits = 0, nan_hits = 0;
    uint64_t folded = 0, folded_errors = 0;  // decisive hits where discs overlap, counted apart
    BoxCheck boxes;                          // of leaves (C++), of rays (device against C++ float)
    Agreement agreement;                     // of a device with C++ float
    LogHistogram distance;                   // |dt| |direction| / r of right hits
    LogHistogram floor;             // ulp(t) |direction| / r of decisive hits: no float t can be better
    LogHistogram margin;            // d of every pair
    IterationHistogram iterations;  // of the C++ float version, of every pair; empty for closed forms
    std::vector<WorstPair> worst;

    uint64_t undecided() const { return pairs - hits - misses - folded; }
};

/// Adds what was said of the pairs; keeps the `keep` worst.
void add_errors(const StressPairs& pairs, std::span<const StressHit> hits, size_t keep, StressTally& tally);

/// Adds the differences between a device's hits and those of the C++ float version, whose curves are given
/// for their radii.
void add_difference(const Curves& curves, std::span<const Ray> rays, std::span<const StressHit> device,
                    std::span<const StressHit> plain, Agreement& agreement);

}  // namespace strandlab
