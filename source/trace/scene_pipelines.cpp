#include "trace/scene_pipelines.h"

#include "shaders/shared/trace_parameters.h"
#include "gpu/embedded_shaders.h"
#include "gpu/query_pipeline.h"
#include "gpu/ray_tracing_pipeline.h"

#include <fmt/format.h>

#include <cassert>

namespace strandlab {
namespace {

constexpr uint32_t counts_work_id = 8;  // shaders/shared/trace.glsl
constexpr auto parameter_bytes = static_cast<uint32_t>(sizeof(layout::TraceParameters));

std::string stem(const std::string& file) { return file.substr(0, file.find('.')); }

}  // namespace

ScenePipelines::ScenePipelines(const Device& device, const Primitive& primitive, PipelineConstants constants,
                               const ShaderRounding& rounding, bool filters_triangles, PipelineStore* store)
    : device_(device),
      shaders_(primitive.shaders),
      primitive_(primitive.name),
      constants_(std::move(constants)),
      rounding_(rounding),
      filters_triangles_(filters_triangles),
      own_store_(store == nullptr ? std::make_unique<PipelineStore>() : nullptr),
      store_(store == nullptr ? own_store_.get() : store) {}

PipelineConstants ScenePipelines::constants_of(const PipelineRequest& request) const {
    PipelineConstants all = constants_;
    all.emplace_back(counts_work_id, request.counts_work ? 1u : 0u);
    return all;
}

std::string ScenePipelines::name_of(const PipelineRequest& request) const {
    std::string name = request.never_hits ? "null" : primitive_;
    if (request.by_query) name += " query";
    if (rounding_.alike) name += rounding_.mends_quotients ? " rounded alike, mended" : " rounded alike";
    for (const auto& [id, bits] : constants_of(request)) name += fmt::format(" {}:{}", id, bits);
    return name;
}

PipelineStore::Pipeline ScenePipelines::make(const PipelineRequest& request) const {
    return store_->get(name_of(request), [&] { return PipelineStore::Pipeline(compile(request)); });
}

std::unique_ptr<TracePipeline> ScenePipelines::compile(const PipelineRequest& request) const {
    const bool has_intersector = !shaders_.intersection.empty();
    assert(has_intersector || !request.never_hits);
    const std::string intersection = request.never_hits ? "null.rint" : shaders_.intersection;
    const PipelineConstants constants = constants_of(request);
    std::vector<uint32_t> alike;  // what the intersector is in place of the embedded one
    const auto intersector = [&](const std::string& name) {
        const std::span<const uint32_t> embedded = embedded_shader(name);
        if (!rounding_.alike || embedded.empty()) return embedded;
        alike = rounded_alike(embedded, rounding_.mends_quotients);
        return std::span<const uint32_t>(alike);
    };
    if (request.by_query) {
        const auto code = intersector(stem(has_intersector ? intersection : shaders_.closest_hit) + ".query");
        assert(!code.empty());
        return std::make_unique<QueryPipeline>(*device_, code, constants, parameter_bytes);
    }
    const std::string any_hit = filters_triangles_ && !has_intersector ? "own_curve.rahit" : shaders_.any_hit;
    const PipelineStages stages{embedded_shader("trace.rgen"), embedded_shader("trace.rmiss"),
                                embedded_shader(shaders_.closest_hit), intersector(intersection),
                                embedded_shader(any_hit)};
    assert(!stages.closest_hit.empty() && (!has_intersector || !stages.intersection.empty()));
    return std::make_unique<RayTracingPipeline>(*device_, stages, constants, parameter_bytes);
}

}  // namespace strandlab
