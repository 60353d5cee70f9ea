// A scene on the device for one primitive: structures, records, pipeline; and tracing rays through it.
#pragma once

#include "shaders/shared/trace_parameters.h"
#include "gpu/acceleration_structure.h"
#include "gpu/device.h"
#include "gpu/ray_tracing_pipeline.h"
#include "primitives/primitive.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// One model of a scene: its geometry for the primitive, and its first curve within the scene.
struct SceneModel {
    Geometry geometry;
    uint32_t first_curve = 0;
};

/// Pipelines of one device, kept for later scenes with the same shaders and constants.
class PipelineStore {
  public:
    using Pipeline = std::shared_ptr<const RayTracingPipeline>;

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

/// How a scene is put on the device.
struct SceneOptions {
    /// Leaf order of the build's input. automatic: median where the driver keeps the order (lavapipe).
    enum class Order { automatic, as_built, median };
    Order order = Order::automatic;
    bool compact = true;
    bool low_memory = false;  // structures smaller, and slower to trace, where the driver can
    /// Largest coordinate of any ray origin: boxes are padded for it.
    float ray_extent = 1.0f;
    /// Normals will be asked for: keeps what they need.
    bool normals = false;
    /// Not 0: ray i meets the curves [i n, (i + 1) n) alone, n being this number, and only what is near them
    /// in the list: every structure is traced with its own rays only. For one model, not moved.
    uint32_t curves_of_a_ray = 0;
    /// Largest leaf count of one structure; 0: what the device allows. Tests make it small.
    uint64_t max_leaves = 0;
    /// fma is known to round once on this device (gpu/arithmetic.h): the ray frame may use it.
    bool hardware_fma = false;
    /// Names of skips (trace/skips.h) that are forced off.
    std::vector<std::string> no_skips;
    /// Where the pipeline is kept for the next scene; none: each scene has its own.
    PipelineStore* pipelines = nullptr;
};

/// What a scene costs besides its builds.
struct SceneCost {
    BuildCost builds;
    double order_ms = 0;        // host: ordering the leaves
    double pipeline_ms = 0;     // host: compiling the shaders, as far as the driver does it now
    uint64_t record_bytes = 0;  // leaves and records, kept while tracing
    uint64_t leaf_count = 0;
    uint32_t structure_count = 0;
    std::vector<std::string> skipped;  // names of the skips taken (trace/skips.h)
};

/// Options of one trace.
struct TraceOptions {
    bool shadow = false;  // any hit will do: hits say only whether there is one (curve 0 and t = tmin)
    uint32_t samples = 1;
    double warm_up_ms = 0;  // device time to spend before the first sample: an idle GPU is slow
};

/// Hits of the last sample, and the device time of each sample in milliseconds.
struct TraceResult {
    Hits hits;
    std::vector<double> milliseconds;
};

/// Rays on the device with room for their hits: made once, traced through any number of scenes.
class GpuRays {
  public:
    /// Invalid rays count as misses. normals: scenes that were made for them may be traced.
    GpuRays(const Device& device, const Rays& rays, bool normals);

    /// What the last trace wrote; undefined before it.
    Hits hits() const;

  private:
    friend class GpuScene;

    size_t count_ = 0;
    uint32_t width_ = 0, height_ = 0;
    Buffer rays_, hits_, normals_;
};

class GpuScene {
  public:
    /// Orders, pads and uploads; builds the structures; compiles the pipeline. The models are consumed.
    /// Several structures are built for a model with more leaves, or larger, than the device takes in one.
    GpuScene(const Device& device, const Primitive& primitive, std::vector<SceneModel> models,
             std::span<const SceneInstance> instances, const SceneOptions& options);

    const SceneCost& cost() const { return cost_; }

    /// Traces all rays; invalid ones count as misses. normals as the scene was made for.
    TraceResult trace(const Rays& rays, const TraceOptions& options = {}) const;
    /// Traces once; the device time in milliseconds. shadow as in TraceOptions.
    double run(GpuRays& rays, bool shadow) const;

  private:
    struct Part {
        AccelerationStructure structure;
        uint32_t model = 0, first_leaf = 0;
    };
    struct ModelBuffers {
        Buffer leaves, leaf_records, curve_records, shading_records;
    };

    /// What a range of rays is traced through.
    struct Top {
        AccelerationStructure structure;
        uint32_t first_ray = 0, end_ray = 0xFFFFFFFFu;
    };

    void add_model(const SceneModel& model, uint32_t index, const SceneOptions& options);
    void add_instances(std::span<const SceneInstance> instances, const std::vector<SceneModel>& models);
    void add_tops(std::span<const InstanceInput> inputs, const std::vector<SceneModel>& models);
    void build_parts(std::span<const BottomLevelInput> inputs, size_t first_part);
    void make_pipeline(const Primitive& primitive, const std::vector<Constant>& constants,
                       PipelineStore* store);
    void choose_skips(std::span<const SceneModel> models, std::span<const SceneInstance> instances);
    /// Whether the skip is taken: possible and not forced off. Notes it in the cost.
    bool skips(const char* name, bool is_possible);
    std::vector<RayTracingPipeline::Launch> launches(const GpuRays& rays, bool shadow) const;
    void add_launches(const GpuRays& rays, layout::TraceParameters parameters, const Top& top,
                      std::vector<RayTracingPipeline::Launch>& all) const;

    Device device_;
    bool normals_ = false;
    uint32_t curves_of_a_ray_ = 0;
    bool hardware_fma_ = false;
    std::vector<std::string> no_skips_;
    bool has_leaf_table_ = true;
    uint32_t uniform_pieces_ = 0;           // of all models; 0: they differ
    bool is_in_place_ = false;              // no instance is moved
    std::vector<layout::GeometryRow> row_;  // the only one, or none
    std::vector<Part> parts_;
    std::vector<ModelBuffers> model_buffers_;
    Buffer rows_;
    std::vector<Top> tops_;
    PipelineStore::Pipeline pipeline_;  // none for an empty scene
    SceneCost cost_;
};

}  // namespace strandlab
