// A scene on the device for one primitive: structures, records, pipeline; and tracing rays through it.
#pragma once

#include "shaders/shared/trace_parameters.h"
#include "gpu/acceleration_structure.h"
#include "gpu/arithmetic.h"
#include "gpu/device.h"
#include "primitives/primitive.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "scene/scene.h"
#include "trace/scene_pipelines.h"
#include "trace/traversal.h"
#include "trace/work_counts.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// Boxes and curve records that were made on the device (trace/grown_model.h).
struct DeviceLeaves {
    Buffer boxes;  // Box[], padded; given up when they are built
    Buffer curve_records;
    size_t count = 0;
};

/// One model of a scene: its geometry for the primitive, and its first curve within the scene.
struct SceneModel {
    Geometry geometry;
    uint32_t first_curve = 0;
    /// Instead of what geometry would hold besides constants and uniform_pieces; one scene takes it. Not
    /// traced on the CPU.
    std::shared_ptr<DeviceLeaves> on_device = nullptr;

    size_t leaf_count() const { return on_device ? on_device->count : geometry.leaf_count(); }
};

/// A number for each curve of all models; none: its own.
using CurveNumbers = std::shared_ptr<const std::vector<uint32_t>>;

/// How a scene is put on the device.
struct SceneOptions {
    /// Leaf order of the build's input. automatic: median where the driver keeps the order (lavapipe).
    enum class Order { automatic, as_built, median };
    Order order = Order::automatic;
    bool compact = true;
    bool low_memory = false;      // structures smaller, and slower to trace, where the driver can
    double build_warm_up_ms = 0;  // device time to spend on the first build before builds are timed
    /// Largest coordinate of any ray origin: boxes are padded for it.
    float ray_extent = 1.0f;
    /// Normals will be asked for: keeps what they need.
    bool normals = false;
    /// Not 0: ray i meets the curves [i n, (i + 1) n) alone, n being this number, and only what is near them
    /// in the list: every structure is traced with its own rays only. For one model, not moved.
    uint32_t curves_of_a_ray = 0;
    /// Largest leaf count of one structure; 0: what the device allows. Tests make it small.
    uint64_t max_leaves = 0;
    /// What is known of the device's arithmetic: a fused fma is used where it is known.
    Arithmetic arithmetic;
    /// query needs a device that was opened with ray queries: Error (no_device) otherwise.
    Traversal traversal = Traversal::pipeline;
    /// Names of skips (trace/skips.h) that are forced off.
    std::vector<std::string> no_skips;
    /// What hits are to name curves instead of by their number among those of the models, where these are not
    /// all that a scene has (trace/culling.h).
    CurveNumbers curve_numbers = nullptr;
    /// Where the pipeline is kept for the next scene; none: each scene has its own.
    PipelineStore* pipelines = nullptr;
};

/// What a scene costs besides its builds.
struct SceneCost {
    BuildCost builds;
    double order_ms = 0;        // host: ordering the leaves
    bool order_cached = false;  // the order was known from an earlier run: order_ms is the time to read it
    double pipeline_ms = 0;     // host: compiling the shaders, as far as the driver does it now
    uint64_t record_bytes = 0;  // leaves and records, kept while tracing
    uint64_t leaf_count = 0;
    uint32_t structure_count = 0;
    std::vector<std::string> skipped;               // names of the skips taken (trace/skips.h)
    Traversal traversal = Traversal::pipeline;      // automatic: until the first rays are traced
    std::optional<TraversalTimes> traversal_times;  // what it was chosen by
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

    /// Room for what instrumented shaders count, all 0.
    void clear_counters(const Device& device);

    size_t count_ = 0;
    uint32_t width_ = 0, height_ = 0;
    Buffer rays_, hits_, normals_, counters_;
    CurveNumbers curve_numbers_;  // of the scene that was traced last, where its hits have curves
};

class GpuScene {
  public:
    /// Orders, pads and uploads; builds the structures; compiles the pipeline. The models are consumed.
    /// Several structures are built for a model with more leaves, or larger, than the device takes in one.
    GpuScene(const Device& device, const Primitive& primitive, std::vector<SceneModel> models,
             std::span<const SceneInstance> instances, const SceneOptions& options);

    const SceneCost& cost() const { return cost_; }
    /// Whether leaves are put into an order of ours for this device.
    static bool reorders(const DeviceInfo& device, const SceneOptions& options);

    /// Traces all rays; invalid ones count as misses. normals as the scene was made for.
    TraceResult trace(const Rays& rays, const TraceOptions& options = {}) const;
    /// Traces once; the device time in milliseconds. shadow as in TraceOptions.
    double run(GpuRays& rays, bool shadow) const;

    /// Traces with instrumented shaders; the hits are the same. Empty for triangles: a driver's own test
    /// tells nothing.
    std::optional<std::vector<RayWork>> count_work(GpuRays& rays, bool shadow) const;
    /// run with an intersector that always misses; nothing for triangles, whose test is the driver's.
    std::optional<double> run_floor(GpuRays& rays, bool shadow) const;
    /// What the driver tells of the shaders that run uses.
    std::vector<ShaderStatistic> shader_statistics() const;

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
                       const SceneOptions& options);
    void order_leaves(Geometry& geometry);
    /// The pipeline for run, which the first rays may have to choose.
    const TracePipeline& pipeline_for(GpuRays& rays, bool shadow) const;
    TraversalTimes measure_traversal(GpuRays& rays, bool shadow) const;
    void choose_skips(std::span<const SceneModel> models, std::span<const SceneInstance> instances);
    /// Whether the skip is taken: possible and not forced off. Notes it in the cost.
    bool skips(const char* name, bool is_possible);
    std::vector<TracePipeline::Launch> launches(const GpuRays& rays, bool shadow) const;
    void add_launches(const GpuRays& rays, layout::TraceParameters parameters, const Top& top,
                      std::vector<TracePipeline::Launch>& all) const;

    Device device_;
    bool normals_ = false;
    uint32_t curves_of_a_ray_ = 0;
    Arithmetic arithmetic_;
    std::vector<std::string> no_skips_;
    CurveNumbers curve_numbers_;
    bool has_leaf_table_ = true;
    uint32_t uniform_pieces_ = 0;           // of all models; 0: they differ
    uint32_t strand_curves_ = 0;            // that share points, in all strands of all models; 0: none do
    bool is_in_place_ = false;              // no instance is moved
    std::vector<layout::GeometryRow> row_;  // the only one, or none
    std::vector<Part> parts_;
    std::vector<ModelBuffers> model_buffers_;
    Buffer rows_;
    std::vector<Top> tops_;
    bool has_intersector_ = false;
    ScenePipelines pipelines_;
    // Chosen by the first rays where the traversal is automatic; none for an empty scene.
    mutable PipelineStore::Pipeline pipeline_;
    mutable SceneCost cost_;
};

}  // namespace strandlab
