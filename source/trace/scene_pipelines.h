// The pipelines that a scene is traced with: the same constants, with what a request adds.
#pragma once

#include "gpu/device.h"
#include "gpu/rounding.h"
#include "gpu/trace_pipeline.h"
#include "primitives/primitive.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace strandlab {

/// Pipelines of one device, kept for later scenes with the same shaders and constants.
class PipelineStore {
  public:
    using Pipeline = std::shared_ptr<const TracePipeline>;

    /// The pipeline of that name, made if there is none yet.
    template <class Make>
    Pipeline get(const std::string& name, Make&& make) {
        Pipeline& pipeline = pipelines_[name];
        if (!pipeline) pipeline = make();
        return pipeline;
    }

  private:
    std::map<std::string, Pipeline> pipelines_;
};

/// Which of a scene's pipelines.
struct PipelineRequest {
    bool by_query = false;     // ray queries instead of a ray-tracing pipeline
    bool counts_work = false;  // instrumented: TraceParameters::counters must lead to room for them
    bool never_hits = false;   // an intersector that always misses in the place of the primitive's
};

class ScenePipelines {
  public:
    ScenePipelines() = default;
    /// constants: of all stages but those of a request. filters_triangles: rays have curves of their own, and
    /// triangles no shader that tells them. store: where pipelines are kept for other scenes; none: here.
    ScenePipelines(const Device& device, const Primitive& primitive, PipelineConstants constants,
                   const ShaderRounding& rounding, bool filters_triangles, PipelineStore* store);

    /// The pipeline; the first time compiles it, as far as the driver does that now.
    PipelineStore::Pipeline make(const PipelineRequest& request) const;
    /// Names shaders and constants: equal names, equal pipelines.
    std::string name_of(const PipelineRequest& request) const;

  private:
    std::unique_ptr<TracePipeline> compile(const PipelineRequest& request) const;
    PipelineConstants constants_of(const PipelineRequest& request) const;

    std::optional<Device> device_;
    PrimitiveShaders shaders_;
    std::string primitive_;
    PipelineConstants constants_;
    ShaderRounding rounding_;
    bool filters_triangles_ = false;
    std::unique_ptr<PipelineStore> own_store_;
    PipelineStore* store_ = nullptr;
};

}  // namespace strandlab
