// strandlab stress --agree cpu-float.
#include "base/error.h"
#include "base/file.h"
#include "commands/stress_report.h"
#include "commands/stress_run.h"
#include "measure/stress_limits.h"
#include "report/result_json.h"
#include "report/table.h"
#include "report/text_format.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace strandlab {
namespace {

struct Cell {
    const StressFamily* family = nullptr;
    const PrimitiveChoice* choice = nullptr;
    const TraceDevice* device = nullptr;
    Agreement agreement;
    StressJudgement judgement;
};

std::string quantile_text(const LogHistogram& values, double q) {
    return values.count() == 0 ? "-" : significant(values.quantile(q), 2);
}

Table table_of(const std::vector<Cell>& cells) {
    Table table({{"family", "", true},
                 {"primitive", "", true},
                 {"device", "", true},
                 {"both hit"},
                 {"only device"},
                 {"only C++"},
                 {"p99.9", "ulp of t"},
                 {"p99.9", "radii"},
                 {"p99.9", "of allowed"},
                 {"max", "of allowed"},
                 {"beyond"},
                 {"verdict", "", true}},
                3);
    for (const Cell& cell : cells) {
        const Agreement& a = cell.agreement;
        table.add_row({cell.family->name, cell.choice->label(), device_text(cell.device->name()),
                       grouped(a.both_hit), grouped(a.only_device), grouped(a.only_cpu),
                       quantile_text(a.ulps, 0.999), quantile_text(a.radii, 0.999),
                       quantile_text(a.allowed, 0.999), quantile_text(a.allowed, 1), grouped(a.beyond()),
                       std::string(verdict_text(cell.judgement.verdict))});
    }
    return table;
}

nlohmann::ordered_json to_json(const Cell& cell, uint64_t seed) {
    const Agreement& a = cell.agreement;
    nlohmann::ordered_json object;
    object["family"] = cell.family->name;
    object["primitive"] = cell.choice->label();
    object["device"] = cell.device->name();
    object["seed"] = seed;
    object["pairs"] = a.pairs;
    object["both_hit"] = a.both_hit;
    object["only_device"] = a.only_device;
    object["only_cpu_float"] = a.only_cpu;
    for (const auto& [name, values] :
         {std::pair("ulps", &a.ulps), {"radii", &a.radii}, {"of_allowed", &a.allowed}})
        object[name] = {{"p99", json_number(values->quantile(0.99))},
                        {"p999", json_number(values->quantile(0.999))},
                        {"max", json_number(values->max())}};
    object["beyond"] = rate_json(a.beyond(), a.hits());
    object["verdict"] = verdict_text(cell.judgement.verdict);
    object["reason"] = cell.judgement.text;
    return object;
}

}  // namespace

int run_agreement(const StressRun& run) {
    std::vector<Cell> cells;
    for (const StressFamily* family : run.families)
        for (const PrimitiveChoice& choice : run.choices)
            for (const auto& device : run.devices) {
                if (device->gpu() == nullptr)
                    fail(ExitCode::usage, "--agree cpu-float: {} is no Vulkan device; pass --device NAME",
                         device->name());
                cells.push_back({family, &choice, device.get(), {}, {}});
            }
    std::vector<PipelineStore> pipelines(run.devices.size());
    for_each_chunk(run, "agreement", [&](size_t family, size_t choice, const StressChunk& chunk) {
        const Primitive& primitive = *chunk.choice.primitive;
        const std::span<const Ray> rays = chunk.pairs.rays;
        BoxCheck boxes;
        const auto plain = intersect_pairs(primitive, chunk.geometry, chunk.pairs, Precision::single, boxes);
        for (size_t d = 0; d < run.devices.size(); ++d) {
            const PairScene scene(*run.devices[d]->gpu(), primitive, chunk.geometry, chunk.pairs.range,
                                  extent_of(rays), &pipelines[d]);
            Cell& cell = cells[(family * run.choices.size() + choice) * run.devices.size() + d];
            add_difference(chunk.curves, rays, scene.trace(rays), plain, cell.agreement);
        }
    });
    bool fails = false;
    std::string lines;
    for (Cell& cell : cells) {
        cell.judgement = judge_agreement(cell.agreement, *cell.choice, *cell.family);
        fails |= cell.judgement.verdict == StressVerdict::fails;
        lines += to_line(to_json(cell, run.seed)) + "\n";
    }
    std::fputs(table_of(cells).to_string(standard_output_style()).c_str(), stdout);
    fmt::print("\nAllowed: max(4 ulp of t, 1e-4 radii) for 99.9 % of hits; other answers count as beyond.\n");
    if (!run.json.empty()) write_file(run.json, lines);
    return static_cast<int>(fails ? ExitCode::threshold : ExitCode::ok);
}

}  // namespace strandlab
