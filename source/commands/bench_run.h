// One run of bench over all its models.
#pragma once

#include "commands/bench_options.h"
#include "measure/bench_case.h"
#include "measure/interleave.h"
#include "measure/scene_group.h"
#include "report/result_writer.h"
#include "trace/culling.h"
#include "trace/trace_device.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace strandlab {

/// Measures the cases of a sweep. For each model and resolution the ray sets are made once; the primitives
/// are built, as many at a time as the device holds; and for each ray set their traces alternate in rounds.
class BenchRun {
  public:
    /// Opens device and files; fills in the options' preset. Keeps a reference to the options.
    explicit BenchRun(BenchOptions& options);

    /// Measures all cases of the shard that no row holds yet, writing rows and printing tables.
    void run();
    /// The rows of this run's cases, old and new.
    const std::vector<nlohmann::ordered_json>& rows() const { return rows_; }
    /// Throws when the validation layers said anything.
    void check_device() const { device_.check_validation(); }

  private:
    struct Block;  // the cases of one model at one resolution
    struct Case;   // of a block

    void run_model(size_t model);
    void run_block(size_t model, size_t resolution, const Scene& scene, const Curves& curves);
    std::vector<Case> open_cases(Block& block);
    std::vector<PrimitiveChoice> choices_within_memory(const Block& block) const;
    bool is_wanted(size_t number) const { return shard_.holds(number, axes_->cases()); }
    bool is_over_budget() const;

    /// The cases of these ray sets.
    void measure_sets(Block& block, const std::vector<size_t>& sets);
    /// Those of one set, without what --cull allows to leave out for its rays.
    void measure_culled(Block& block, size_t set);
    void measure_set(Block& block, size_t set, const std::vector<const PreparedCase*>& group,
                     const PreparedCase* baseline);
    std::vector<TimeSamples> time_all(const Block& block, size_t set,
                                      const std::vector<const PreparedCase*>& traced, TracedRays& rays) const;
    void measure_embree(Block& block);
    /// How pictures err from farther away, of the open cases that have pictures.
    void measure_distances(Block& block) const;
    bool is_within_limits(const ResultRow& row);
    void add(Block& block, ResultRow row);

    ResultRow base_row(const Block& block, size_t set, size_t primitive) const;
    std::string device_line() const;
    /// What files of a model are called; with the resolution behind `separator` where the sweep has several.
    std::string file_stem(const Block& block, const char* separator) const;
    CaseFiles write_pictures(Block& block, const PreparedCase& prepared, const MeasuredRays& rays,
                             const Hits& hits) const;

    BenchOptions& options_;
    TraceDevice device_;
    std::vector<PrimitiveChoice> choices_;
    Caps caps_ = Caps::round;
    Culling culling_;
    CurveOptions curve_options_;
    std::vector<Resolution> resolutions_;
    Shard shard_;
    std::shared_ptr<const SweepAxes> axes_;
    std::vector<std::string> model_files_, ray_files_, primitive_files_;  // parts of file names, of the axes
    uint64_t sweep_id_ = 0;
    size_t baseline_ = 0;  // index of the baseline primitive
    bool with_embree_ = false;
    std::unique_ptr<ResultWriter> writer_;
    Context context_;
    std::map<std::string, nlohmann::ordered_json> finished_;  // rows of --resume by key
    std::set<std::string> seen_;                              // keys of all cases so far
    std::vector<nlohmann::ordered_json> rows_;
    std::chrono::steady_clock::time_point start_;
    size_t left_out_ = 0;
};

}  // namespace strandlab
