// What a run of bench is asked for.
#pragma once

#include "commands/arguments.h"
#include "commands/ray_arguments.h"
#include "report/result_row.h"
#include "report/sweep.h"
#include "trace/culling.h"
#include "trace/gpu_scene.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace strandlab {

struct BenchOptions {
    ModelArguments models;
    PrimitiveArguments primitives;
    RayArguments rays;
    DeviceArguments device;
    std::string preset = "default";
    std::optional<uint32_t> repeat;
    std::string json, csv, images, save_rays, scale_chart, leaf_order = "auto";
    std::string baseline_primitive;  // its label; empty: the first
    std::string baseline;            // result file to compare with
    std::string shard_text = "1/1";
    uint32_t interleave = 0;                                // primitives at a time; 0: as many as fit
    double bytes_per_curve = 0;                             // 0: leaves as the primitives say
    double max_error = 0, max_memory = 0, time_budget = 0;  // 0: no limit
    bool resume = false;
    bool no_embree = false, no_compaction = false, no_normals = false, low_memory = false;
    std::string cull;  // what need not be built; empty: all is
    std::vector<std::string> no_skips;
    bool explain = false, ablation = false, profile = false;
    bool lod = false;

    void add_to(CLI::App& app);
    bool has_error_rays() const;  // --error-rays was given

    /// Throws Error (usage) where options do not go together or a value cannot be: before any work.
    void check() const;
    Shard shard() const { return parse_shard(shard_text); }
    SceneOptions::Order order() const;
    DeviceOptions device_options() const;
    /// What --cull allows and --no-skip does not force off.
    Culling culling() const;
    /// Sets what of the options says how scenes are put on the device.
    void apply_to(SceneOptions& scene) const;
    /// Of --resolution, "WIDTHxHEIGHT" separated by commas; throws Error (usage).
    std::vector<Resolution> resolutions() const;

  private:
    CLI::Option* error_rays_ = nullptr;
};

/// "640x360".
std::string to_string(const Resolution& resolution);

/// One command that makes one case again: its model, rays and primitive (besides the baseline primitive),
/// with all other options as they were.
std::string reproducing_command(const BenchOptions& options, const ResultRow& row);

}  // namespace strandlab
