#include "trace/work_counts.h"

#include <algorithm>

namespace strandlab {

void WorkCounts::add(const RayWork& ray) {
    ++rays;
    leaves += ray.leaves;
    searched += ray.searched;
    iterations += ray.iterations;
    reports += ray.reports;
    most_leaves = std::max(most_leaves, ray.leaves);
    most_iterations = std::max(most_iterations, ray.iterations);
}

WorkCounts sum_of(std::span<const RayWork> rays) {
    WorkCounts all;
    for (const RayWork& ray : rays) all.add(ray);
    return all;
}

}  // namespace strandlab
