// Stress pairs through Embree.
#include "base/parallel.h"
#include "measure/stress.h"
#include "trace/embree_reference.h"

namespace strandlab {

std::vector<StressHit> trace_pairs_with_embree(const Surface& surface, const StressPairs& pairs) {
    const std::vector<Surface> parts =
        strand_surfaces(surface, pairs.range.count, pairs.range.family->curves);
    std::vector<StressHit> hits(pairs.rays.size());
    parallel_for(hits.size(), [&](size_t i) {
        if (parts[i].pieces.empty() && parts[i].triangles.empty()) return;
        const EmbreeScene scene(parts[i]);
        Hit hit;
        scene.trace(std::span(&pairs.rays[i], 1), std::span(&hit, 1));
        hits[i] = {double(hit.t), double(hit.u), hit.curve};
    });
    return hits;
}

}  // namespace strandlab
