// One case of a benchmark: everything that is known about it, once.
#pragma once

#include "gpu/device.h"
#include "measure/comparison.h"
#include "measure/trace_profile.h"
#include "primitives/primitive.h"
#include "report/context.h"
#include "report/distant_pictures.h"
#include "report/sweep.h"
#include "scene/rays.h"
#include "strands/curves.h"
#include "trace/culling.h"
#include "trace/gpu_scene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace strandlab {

/// The model that was traced.
struct ModelFacts {
    std::string name;
    uint64_t hash = 0;  // of the curves and strands
    size_t curves = 0, strands = 0;
    size_t instances = 1;
    std::string spec = {};  // file or generator as the command line named it
};
ModelFacts facts_of(std::string name, const Curves& curves, size_t instances = 1);

/// The rays that were traced. Of a picture, width and height are pixels and samples are per pixel; other
/// sets have 0 samples and their launch shape.
struct RayFacts {
    std::string name;
    size_t count = 0;
    uint64_t hash = 0;
    uint32_t width = 0, height = 0, samples = 0;
    std::string kind = {};  // of the named sets, or "file"
    bool shuffled = false;
    bool as_shadow = false;  // traced up to any hit, whatever the kind
    uint64_t seed = 0;
    std::string camera = {};      // as --camera reads it; empty: the set comes from no picture
    std::string resolution = {};  // of the sweep, also where the set is no picture
};
RayFacts facts_of(const Rays& rays, uint32_t samples = 0);

/// The primitive with all its parameters, and the caps that it used.
struct PrimitiveFacts {
    std::string name, label;
    std::vector<std::pair<std::string, std::string>> parameters;  // all, in the order of its table
    Caps caps = Caps::round;
    Caps wanted_caps = Caps::round;  // those of the scene

    /// The primitive cannot do the scene's caps and used its own.
    bool caps_fell_back() const { return caps != wanted_caps; }
};
PrimitiveFacts facts_of(const PrimitiveChoice& choice, Caps wanted_caps);

/// Where the rays were traced. Rows of software and of hardware traversal are never compared.
struct DeviceFacts {
    std::string name, driver, api_version, kind;
    bool hardware_traversal = false;
    bool validation_layers = false;
    uint64_t memory_bytes = 0;  // of the largest heap of its own; 0: not known

    std::string_view device_class() const { return hardware_traversal ? "hardware" : "software"; }
};
DeviceFacts facts_of(const DeviceInfo& info, bool validation_layers);

/// How a case was measured, where not its primitive or rays say so.
struct BenchSettings {
    uint32_t repeat = 0;
    double warm_up_ms = 0;
    size_t error_rays = 0;
    std::string leaf_order = "auto";
    bool compaction = true, normals = true, low_memory = false;
    std::string traversal = "pipeline";  // as asked for; the row's cost has the one that was used
    std::vector<std::string> no_skips;   // forced off
    Caps caps = Caps::round;
    double bytes_per_curve = 0;                // limit of --bytes-per-curve; 0: none
    std::string cull = {};                     // what --cull allows to leave out; empty: nothing
    std::optional<StrandCount> left_out = {};  // by that; no part of the key

    /// " order=median compaction=0 normals=0": what changes the case and is not the default.
    std::string key() const;
};

/// Times relative to the baseline primitive's, taken in the same rounds.
struct TimeRatio {
    std::string baseline;  // its label
    std::vector<double> samples;
};

/// Pictures of a case, as files; empty where there is none.
struct CaseFiles {
    std::string rendered, reference, error_map;
};

/// A finished case. What was not measured is empty, never 0.
struct ResultRow {
    static constexpr int schema = 2;  // raised whenever a field changes its meaning or goes

    std::string command = "bench";
    SweepFacts sweep;
    std::string reproduce;  // the command that makes this row again
    ModelFacts model;
    RayFacts rays;
    PrimitiveFacts primitive;
    DeviceFacts device;
    BenchSettings settings;
    std::vector<double> trace_ms;  // device time of every sample in the order of measurement
    std::vector<double> wall_ms;   // host clock around the same
    std::vector<uint32_t>
        positions;      // place of each sample in its round's random order; empty: not interleaved
    std::string group;  // rows with the same one were interleaved: sample i of all is round i
    std::optional<TimeRatio> ratio;
    std::optional<double> geometry_ms;  // host: making leaves and records from the curves
    std::optional<double> cull_ms;      // host: finding out what need not be built
    std::optional<SceneCost> cost;
    std::optional<Comparison> intersector_error;  // against the primitive's own surface
    std::optional<Comparison> model_error;        // against the common reference
    std::optional<TraceProfile> profile;          // where one is wanted
    CaseFiles images;                             // of primary rays, where pictures are wanted
    std::vector<DistantError> distances;          // with them; nearest first
    uint64_t seed = 0;
    Context context;

    /// Of trace_ms; the bootstrap is seeded by the row's seed.
    std::optional<Summary> trace_time() const;
    std::optional<Summary> wall_time() const;
    std::optional<Summary> ratio_summary() const;
    /// Half the distance from the 5th to the 95th percentile over the median: 0.05 is +-5 %.
    std::optional<double> spread() const;
    /// What to do about a spread that is too wide to rely on; empty: it is not.
    std::string warning() const;
    /// Million rays a second at the median time.
    std::optional<double> mrays_per_second() const;
    /// Bytes that stay on the device while tracing: structures and records.
    std::optional<uint64_t> resident_bytes() const;
    /// Bytes that the program itself puts on the device (build input and records), without structures: what
    /// articles often state as the memory of a primitive.
    std::optional<uint64_t> buffer_bytes() const;
    /// resident_bytes() per curve of the model.
    std::optional<double> bytes_per_curve() const;
    /// Equal for rows that measure the same thing on the same device: model, rays, primitive, caps, device,
    /// seed, settings. What --resume and --baseline match rows by.
    std::string key() const;
};

}  // namespace strandlab
