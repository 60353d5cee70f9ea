// strandlab stress --self-intersection.
#include "base/error.h"
#include "base/file.h"
#include "commands/stress_report.h"
#include "commands/stress_run.h"
#include "measure/statistics.h"
#include "measure/stress_spawn.h"
#include "report/result_json.h"
#include "report/table.h"
#include "report/text_format.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace strandlab {
namespace {

struct Cell {
    const StressFamily* family = nullptr;
    const PrimitiveChoice* choice = nullptr;
    const TraceDevice* device = nullptr;
    SpawnTally tally;
    StressJudgement judgement;

    bool has_ladder() const { return device->gpu() == nullptr; }
};

std::string needed_text(const Cell& cell, double value) {
    return !cell.has_ladder() ? "-" : value == 0 ? "0" : significant(value, 2);
}

Table table_of(const std::vector<Cell>& cells) {
    Table table({{"family", "", true},
                 {"primitive", "", true},
                 {"device", "", true},
                 {"hits left"},
                 {"rays"},
                 {"self-hits", "unmoved"},
                 {"needs", "radii"},
                 {"needs", "ulp"},
                 {"moved by", "radii"},
                 {"or", "ulp"},
                 {"self-hits", "moved"},
                 {"own hits", "right"},
                 {"shadow rays"},
                 {"differ"},
                 {"verdict", "", true}},
                3);
    for (const Cell& cell : cells) {
        const SpawnTally& t = cell.tally;
        const SpawnOffset& offset = cell.choice->primitive->spawn;
        table.add_row({cell.family->name, cell.choice->label(), device_text(cell.device->name()),
                       grouped(t.hits), grouped(t.rays), cell.has_ladder() ? grouped(t.unmoved) : "-",
                       needed_text(cell, t.radii_needed), needed_text(cell, t.ulps_needed),
                       significant(offset.radii, 2), significant(offset.ulps, 2), grouped(t.self_hits),
                       grouped(t.own_hits), grouped(t.shadow_rays), grouped(t.shadow_differs),
                       std::string(verdict_text(cell.judgement.verdict))});
    }
    return table;
}

nlohmann::ordered_json to_json(const Cell& cell, uint64_t seed) {
    const SpawnTally& t = cell.tally;
    const SpawnOffset& offset = cell.choice->primitive->spawn;
    nlohmann::ordered_json object;
    object["family"] = cell.family->name;
    object["primitive"] = cell.choice->label();
    object["device"] = cell.device->name();
    object["seed"] = seed;
    object["hits"] = t.hits;
    object["rays"] = t.rays;
    object["offset"] = {{"radii", offset.radii}, {"ulps", offset.ulps}};
    object["self_hits"] = rate_json(t.self_hits, t.rays);
    if (cell.has_ladder()) {
        object["self_hits_unmoved"] = rate_json(t.unmoved, t.rays);
        object["needs"] = {{"radii", json_number(t.radii_needed)}, {"ulps", json_number(t.ulps_needed)}};
    }
    object["own_hits"] = t.own_hits;
    object["shadow_differs"] = rate_json(t.shadow_differs, t.shadow_rays);
    object["verdict"] = verdict_text(cell.judgement.verdict);
    object["reason"] = cell.judgement.text;
    return object;
}

void add_chunk(const StressChunk& chunk, std::span<Cell> cells, std::span<PipelineStore> pipelines) {
    const Primitive& primitive = *chunk.choice.primitive;
    const StressRange& range = chunk.pairs.range;
    const std::vector<SpawnPoint> points =
        spawn_points(primitive, chunk.geometry, chunk.surface, chunk.pairs);
    for (size_t d = 0; d < cells.size(); ++d) {
        Cell& cell = cells[d];
        const Device* gpu = cell.device->gpu();
        if (gpu == nullptr) {
            add_spawned(primitive, chunk.geometry, chunk.surface, range, points, cell.tally);
            continue;
        }
        // The rays start near the strands, whose boxes know their own size.
        const PairScene scene(*gpu, primitive, chunk.geometry, range, 0, &pipelines[d]);
        add_spawned(scene, primitive, chunk.surface, range, points, cell.tally);
    }
}

}  // namespace

int run_self_intersection(const StressRun& run) {
    for (const auto& device : run.devices)
        if (device->name() == "cpu-double")
            fail(ExitCode::usage,
                 "--device cpu-double: --self-intersection is about float; pass cpu-float or a device");
    std::vector<Cell> cells;
    for (const StressFamily* family : run.families)
        for (const PrimitiveChoice& choice : run.choices)
            for (const auto& device : run.devices) cells.push_back({family, &choice, device.get(), {}, {}});
    const size_t devices = run.devices.size();
    std::vector<PipelineStore> pipelines(devices);
    for_each_chunk(run, "self-intersection", [&](size_t family, size_t choice, const StressChunk& chunk) {
        add_chunk(chunk, std::span(cells).subspan((family * run.choices.size() + choice) * devices, devices),
                  pipelines);
    });
    bool fails = false;
    std::string lines;
    for (Cell& cell : cells) {
        cell.judgement = judge_spawned(cell.tally, *cell.choice->primitive, *cell.family);
        fails |= cell.judgement.verdict == StressVerdict::fails;
        lines += to_line(to_json(cell, run.seed)) + "\n";
    }
    std::fputs(table_of(cells).to_string(standard_output_style()).c_str(), stdout);
    if (!run.json.empty()) write_file(run.json, lines);
    return static_cast<int>(fails ? ExitCode::threshold : ExitCode::ok);
}

}  // namespace strandlab
