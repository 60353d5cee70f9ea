// strandlab stress --agree cpu-float.
#include "commands/stress_cells.h"
#include "report/text_format.h"

#include <fmt/core.h>

#include <algorithm>

namespace strandlab {
namespace {

using Cell = DeviceCell<Agreement>;

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
        const Agreement& a = cell.tally;
        table.add_row({cell.family->name, cell.choice->label(), device_text(cell.device->name()),
                       grouped(a.both_hit), grouped(a.only_device), grouped(a.only_cpu),
                       quantile_text(a.ulps, 0.999), quantile_text(a.radii, 0.999),
                       quantile_text(a.allowed, 0.999), quantile_text(a.allowed, 1), grouped(a.beyond()),
                       std::string(verdict_text(cell.judgement.verdict))});
    }
    return table;
}

void add_json(const Cell& cell, nlohmann::ordered_json& object) {
    const Agreement& a = cell.tally;
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
}

std::string rounding_text(const StressRun& run, const TraceDevice& device) {
    const Arithmetic& arithmetic = device.arithmetic();
    if (!arithmetic.rounds_loosely()) return "rounds as C++ does";
    if (std::count(run.no_skips.begin(), run.no_skips.end(), "rounding") != 0)
        return "made to round as C++ does (--no-skip rounding)";
    return arithmetic.to_string() + "; --no-skip rounding makes it round as C++ does";
}

}  // namespace

int run_agreement(const StressRun& run) {
    for (const auto& device : run.devices)
        if (device->gpu() == nullptr)
            fail(ExitCode::usage, "--agree cpu-float: {} is no Vulkan device; pass --device NAME",
                 device->name());
    DeviceCells<Agreement> cells(run);
    std::vector<StressDevice> devices = devices_of(run);
    for_each_chunk(run, "agreement", [&](size_t family, size_t choice, const StressChunk& chunk) {
        const Primitive& primitive = *chunk.choice.primitive;
        const std::span<const Ray> rays = chunk.pairs.rays;
        BoxCheck boxes;
        const auto plain = intersect_pairs(primitive, chunk.geometry, chunk.pairs, Precision::single, boxes);
        for (size_t d = 0; d < devices.size(); ++d) {
            const PairScene scene =
                devices[d].scene(primitive, chunk.geometry, chunk.pairs.range, extent_of(rays));
            add_difference(chunk.curves, rays, scene.trace(rays), plain, cells.of(family, choice)[d].tally);
        }
    });
    const int code =
        cells.finish([](const Cell& cell) { return judge_agreement(cell.tally, *cell.choice, *cell.family); },
                     table_of, add_json);
    fmt::print("\nAllowed: max(4 ulp of t, 1e-4 radii) for 99.9 % of hits; other answers count as beyond.\n");
    for (const auto& device : run.devices)
        fmt::print("{}: {}\n", device->name(), rounding_text(run, *device));
    return code;
}

}  // namespace strandlab
