// How a device walks its acceleration structure.
#pragma once

#include <optional>
#include <string_view>

namespace strandlab {

/// pipeline: a ray-tracing pipeline; query: ray queries in a compute shader; automatic: the faster of the
/// two, measured once for each device and shader.
enum class Traversal { pipeline, query, automatic };

std::string_view name_of(Traversal traversal);

/// "pipeline", "query", "auto"; throws Error (usage) for anything else.
Traversal parse_traversal(std::string_view text);

/// What `automatic` chose between: the times of the same rays, of this run or an earlier one.
struct TraversalTimes {
    double pipeline_ms = 0, query_ms = 0;

    Traversal faster() const { return query_ms < pipeline_ms ? Traversal::query : Traversal::pipeline; }
};

}  // namespace strandlab
