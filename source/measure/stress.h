// Intersectors on families of pairs: each ray meets its own strand alone, and the oracle of the
// intersector's own surface says what is right.
#pragma once

#include "measure/log_histogram.h"
#include "measure/stress_families.h"
#include "primitives/primitive.h"
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

/// The right answer for one pair.
struct StressAnswer {
    double t = 0, radius = 0;
    double margin = 0;  // d: the relative change of radii that a decisive answer survives
    bool is_hit = false;
    bool decisive = false;        // hit or miss is the same for radii scaled by 1 +- d
    bool decisive_place = false;  // and the hit moves by less than 0.3 radii
};

/// Pairs whose rays are aimed at one surface, with the oracle's answers.
struct StressPairs {
    StressRange range;
    std::vector<Ray> rays;
    std::vector<StressAnswer> answers;
};

/// Aims the rays at the surface (of the strands of the range), and asks the oracle. A ray is decisive when
/// the answer is the same for radii scaled by 1 +- d, d = max(1e-3, 8 ulp(largest coordinate of the piece
/// relative to its first point) / radius), open ends moved by 1e-3 of the piece, and the ray's interval
/// shortened and lengthened by 8 ulp. Where the radius vanishes nothing is decisive.
StressPairs stress_pairs(const StressRange& range, const Surface& surface);

/// What an intersector said of one pair.
struct StressHit {
    double t = 0;
    bool is_hit = false;
};

/// Strand after strand through Embree's curves (a scene each), which decide by their own definition. Surface:
/// that of the pairs. Where Embree is not built in: Error (usage).
std::vector<StressHit> trace_pairs_with_embree(const Surface& surface, const StressPairs& pairs);

/// The surface cut into the parts of single strands of so many curves each.
std::vector<Surface> strand_surfaces(const Surface& surface, uint64_t strands, uint32_t curves);

/// Hits that a box had to let through, and those that it lost.
struct BoxCheck {
    uint64_t lost = 0, trials = 0;

    void add(const BoxCheck& other) {
        lost += other.lost;
        trials += other.trials;
    }
};

/// The C++ version alone, leaf after leaf, without any box. boxes counts leaf hits, and those whose padded
/// box a plain slab test in float misses, with the padding of a builder that knows the farthest origin.
std::vector<StressHit> intersect_pairs(const Primitive& primitive, const Geometry& geometry,
                                       const StressPairs& pairs, Precision precision, BoxCheck& boxes);

/// Through acceleration structures of the device, each of a few hundred pairs, where every ray meets its own
/// strand only: what the C++ version finds and this does not was lost by a box, or by the arithmetic of the
/// device. The geometry is consumed.
std::vector<StressHit> trace_pairs(const Device& device, const Primitive& primitive, Geometry geometry,
                                   const StressPairs& pairs);

/// A pair to look at, and how wrong it is: radii of a wrong place; 1e6 for hit or miss, 1e9 for NaN.
struct WorstPair {
    double error = 0;
    uint64_t index = 0;
    Ray ray;
};

/// Sums over the pairs of one family, primitive and device.
struct StressTally {
    uint64_t pairs = 0;
    uint64_t hits = 0, misses = 0;  // decisive, by the oracle
    uint64_t false_misses = 0, false_hits = 0, wrong_hits = 0, nan_hits = 0;
    BoxCheck boxes;          // of leaves (C++), of rays (device against C++ float)
    uint64_t differing = 0;  // device against C++ float: hit or miss, or t beyond max(4 ulp, 1e-4 r)
    uint64_t compared = 0;
    LogHistogram distance;  // |dt| |direction| / r of right hits
    LogHistogram floor;     // ulp(t) |direction| / r of decisive hits: no float t can be better
    LogHistogram margin;    // d of every pair
    std::vector<WorstPair> worst;

    uint64_t undecided() const { return pairs - hits - misses; }
};

/// Adds what was said of the pairs; keeps the `keep` worst.
void add_errors(const StressPairs& pairs, std::span<const StressHit> hits, size_t keep, StressTally& tally);

/// Adds the difference between a device's hits and those of the C++ version of the same text.
void add_difference(const StressPairs& pairs, std::span<const StressHit> device,
                    std::span<const StressHit> plain, StressTally& tally);

}  // namespace strandlab
