// strandlab stress --watertight.
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

#include <cstdio>

namespace strandlab {
namespace {

struct Cell {
    uint64_t pairs = 0;
    BoxCheck single, precise;
};

/// All cells of families that floats resolve, or of the others. Where t itself may be off by radii, no point
/// is asked for.
BoxCheck sum_of(const StressRun& run, const std::vector<Cell>& cells, bool resolvable) {
    BoxCheck sum;
    for (size_t i = 0; i < cells.size(); ++i) {
        const StressFamily& family = *run.families[i / run.choices.size()];
        if (family.is_resolvable() != resolvable) continue;
        BoxCheck cell = cells[i].single;
        cell.add(cells[i].precise);
        if (!unknown_places(*run.choices[i % run.choices.size()].primitive, family).empty()) cell.outside = 0;
        sum.add(cell);
    }
    return sum;
}

std::string text_of(const BoxCheck& sum, const char* which) {
    return fmt::format("{}: {} leaf hits, {} lost by a slab test in float, {} outside of their box\n", which,
                       grouped(sum.trials), grouped(sum.lost), grouped(sum.outside));
}

nlohmann::ordered_json to_json(const StressFamily& family, const PrimitiveChoice& choice, uint64_t seed,
                               const Cell& cell) {
    nlohmann::ordered_json object;
    object["family"] = family.name;
    object["primitive"] = choice.label();
    object["seed"] = seed;
    object["pairs"] = cell.pairs;
    for (const auto& [name, check] : {std::pair("float", cell.single), {"double", cell.precise}})
        object[name] = {{"lost_by_slab_test", rate_json(check.lost, check.trials)},
                        {"outside_of_box", rate_json(check.outside, check.trials)}};
    return object;
}

std::string report(const StressRun& run, const std::vector<Cell>& cells, std::string& lines) {
    Table table({{"family", "", true},
                 {"primitive", "", true},
                 {"pairs"},
                 {"leaf hits", "float"},
                 {"lost by slab"},
                 {"outside"},
                 {"leaf hits", "double"},
                 {"lost by slab"},
                 {"outside"}},
                2);
    uint64_t pairs = 0;
    for (size_t i = 0; i < cells.size(); ++i) {
        const StressFamily& family = *run.families[i / run.choices.size()];
        const PrimitiveChoice& choice = run.choices[i % run.choices.size()];
        const Cell& cell = cells[i];
        pairs += cell.pairs;
        table.add_row({family.name, choice.label(), grouped(cell.pairs), grouped(cell.single.trials),
                       grouped(cell.single.lost), grouped(cell.single.outside), grouped(cell.precise.trials),
                       grouped(cell.precise.lost), grouped(cell.precise.outside)});
        lines += to_line(to_json(family, choice, run.seed, cell)) + "\n";
    }
    const BoxCheck judged = sum_of(run, cells, true), others = sum_of(run, cells, false);
    std::string text = table.to_string(standard_output_style()) + fmt::format("\n{} pairs\n", grouped(pairs));
    if (judged.trials > 0) text += text_of(judged, "families that floats resolve");
    if (others.trials > 0) text += text_of(others, "other families (not judged)");
    return text;
}

}  // namespace

int run_watertight(const StressRun& run) {
    std::vector<Cell> cells(run.families.size() * run.choices.size());
    for_each_chunk(run, "watertight", [&](size_t family, size_t choice, const StressChunk& chunk) {
        Cell& cell = cells[family * run.choices.size() + choice];
        const Primitive& primitive = *chunk.choice.primitive;
        cell.pairs += chunk.pairs.range.count;
        intersect_pairs(primitive, chunk.geometry, chunk.pairs, Precision::single, cell.single);
        intersect_pairs(primitive, chunk.geometry, chunk.pairs, Precision::precise, cell.precise);
    });
    std::string lines;
    std::fputs(report(run, cells, lines).c_str(), stdout);
    if (!run.json.empty()) write_file(run.json, lines);
    const BoxCheck sum = sum_of(run, cells, true);
    return static_cast<int>(sum.lost + sum.outside > 0 ? ExitCode::threshold : ExitCode::ok);
}

}  // namespace strandlab
