#include "commands/stress_report.h"

#include "base/error.h"
#include "base/npy.h"
#include "measure/statistics.h"
#include "report/result_json.h"
#include "report/table.h"
#include "report/text_format.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace strandlab {
namespace {

nlohmann::ordered_json iterations_json(const IterationHistogram& iterations) {
    if (iterations.count() == 0) return {};
    return {{"mean", json_number(iterations.mean())},
            {"p50", iterations.quantile(0.5)},
            {"p99", iterations.quantile(0.99)},
            {"max", iterations.max()},
            {"rays_by_count", iterations.counts()}};
}

/// The counts of octaves that are not empty, by their exponent: {"-17": 1200} lie in [2^-17, 2^-16).
nlohmann::ordered_json octaves_json(const LogHistogram& values) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (int exponent = LogHistogram::first_octave; exponent < LogHistogram::last_octave; ++exponent)
        if (const uint64_t count = values.octave(exponent); count > 0)
            object[std::to_string(exponent)] = count;
    return object;
}

nlohmann::ordered_json cell_json(const StressCell& cell, uint64_t seed,
                                 std::span<const std::string> no_skips) {
    const StressTally& t = cell.tally;
    nlohmann::ordered_json object;
    object["family"] = cell.family->name;
    object["primitive"] = cell.label;
    object["device"] = cell.device;
    object["seed"] = seed;
    object["no_skips"] = no_skips;
    object["pairs"] = t.pairs;
    object["decisive_hits"] = t.hits;
    object["decisive_misses"] = t.misses;
    object["undecided"] = t.undecided();
    object["margin_p50"] = json_number(t.margin.quantile(0.5));
    object["false_misses"] = rate_json(t.false_misses, t.hits);
    object["false_hits"] = rate_json(t.false_hits, t.misses);
    object["wrong_places"] = rate_json(t.wrong_hits, t.hits);
    object["nan_hits"] = t.nan_hits;
    object["wrong_where_discs_overlap"] = rate_json(t.folded_errors, t.folded);
    for (const auto& [key, q] :
         {std::pair("distance_p50", 0.5), {"distance_p99", 0.99}, {"distance_p999", 0.999}})
        object[key] = json_number(t.distance.quantile(q));
    object["distance_max"] = json_number(t.distance.max());
    object["distance_by_octave"] = octaves_json(t.distance);
    object["ulp_p99"] = json_number(t.floor.quantile(0.99));
    object["lost_by_boxes"] = rate_json(t.boxes.lost, t.boxes.trials);
    object["outside_of_boxes"] = rate_json(t.boxes.outside, t.boxes.trials);
    object["differs_from_cpu_float"] = t.agreement.pairs == 0
                                           ? nlohmann::ordered_json()
                                           : rate_json(t.agreement.beyond(), t.agreement.pairs);
    object["iterations"] = iterations_json(t.iterations);
    object["verdict"] = verdict_text(cell.judgement.verdict);
    object["reason"] = cell.judgement.text;
    return object;
}

/// A name that a file may have.
std::string file_name(std::string text) {
    for (char& c : text)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
    return text;
}

}  // namespace

std::string_view verdict_text(StressVerdict verdict) {
    switch (verdict) {
        case StressVerdict::holds: return "holds";
        case StressVerdict::fails: return "FAILS";
        case StressVerdict::not_judged: break;
    }
    return "not judged";
}

std::string device_text(const std::string& name) { return name.substr(0, name.find(" (")); }

std::string quantile_text(const LogHistogram& values, double q) {
    return values.count() == 0 ? "-" : significant(values.quantile(q), 2);
}

nlohmann::ordered_json rate_json(uint64_t count, uint64_t trials) {
    const Interval bounds = binomial_bounds(count, trials);
    return {{"count", count},
            {"trials", trials},
            {"bounds_95", {json_number(bounds.low), json_number(bounds.high)}}};
}

std::string iterations_text(const IterationHistogram& iterations) {
    if (iterations.count() == 0) return "-";
    return fmt::format("{} / {} / {}", significant(iterations.mean()), iterations.quantile(0.99),
                       iterations.max());
}

std::string stress_family_help() {
    std::string text = "Families (--family NAME):\n";
    for (const StressFamily& family : stress_families())
        text += fmt::format("  {:<14} {}{}\n", family.name, family.help,
                            family.is_resolvable() ? "" : " (reported, not judged)");
    return text;
}

std::string stress_table(std::span<const StressCell> cells) {
    Table table({{"family", "", true},
                 {"primitive", "", true},
                 {"device", "", true},
                 {"hits", "decisive"},
                 {"misses", "decisive"},
                 {"undecided"},
                 {"false miss"},
                 {"false hit"},
                 {"wrong place"},
                 {"dt p50", "radii"},
                 {"dt p99", "radii"},
                 {"lost by box"},
                 {"not as C++"},
                 {"iterations", "mean / p99 / max"},
                 {"NaN"},
                 {"verdict", "", true}},
                3);
    for (const StressCell& cell : cells) {
        const StressTally& t = cell.tally;
        table.add_row(
            {cell.family->name, cell.label, device_text(cell.device), grouped(t.hits), grouped(t.misses),
             percent(double(t.undecided()) / double(std::max<uint64_t>(1, t.pairs))), grouped(t.false_misses),
             grouped(t.false_hits), grouped(t.wrong_hits), quantile_text(t.distance, 0.5),
             quantile_text(t.distance, 0.99), grouped(t.boxes.lost),
             t.agreement.pairs == 0 ? "-" : grouped(t.agreement.beyond()), iterations_text(t.iterations),
             grouped(t.nan_hits), std::string(verdict_text(cell.judgement.verdict))});
    }
    return table.to_string(standard_output_style());
}

std::string stress_summary(std::span<const StressCell> cells) {
    uint64_t holds = 0, fails = 0, not_judged = 0;
    BoxCheck leaves;
    Agreement agreement;
    std::string failures, folds;
    for (const StressCell& cell : cells) {
        const StressVerdict verdict = cell.judgement.verdict;
        ++(verdict == StressVerdict::holds ? holds : verdict == StressVerdict::fails ? fails : not_judged);
        BoxCheck boxes = cell.tally.boxes;
        if (cell.primitive && !unknown_places(*cell.primitive, *cell.family).empty()) boxes.outside = 0;
        leaves.add(boxes);
        agreement.only_cpu += cell.tally.agreement.only_cpu;
        agreement.both_hit += cell.tally.agreement.both_hit;
        if (cell.tally.folded_errors > 0)
            folds += fmt::format("discs overlap: {}, {}, {}: {} of {} hits there are wrong, not judged\n",
                                 cell.family->name, cell.label, device_text(cell.device),
                                 grouped(cell.tally.folded_errors), grouped(cell.tally.folded));
        if (verdict == StressVerdict::fails)
            failures += fmt::format("FAILS: {}, {}, {}: {}\n", cell.family->name, cell.label,
                                    device_text(cell.device), cell.judgement.text);
    }
    std::string text = fmt::format("\n{} hold, {} fail, {} are not judged\n", holds, fails, not_judged);
    if (leaves.trials > 0)
        text +=
            fmt::format("boxes: {} of {} leaf hits lost by a slab test in float, {} outside of their box\n",
                        grouped(leaves.lost), grouped(leaves.trials), grouped(leaves.outside));
    if (agreement.only_cpu + agreement.both_hit > 0)
        text += fmt::format("devices: {} of {} hits of the C++ float version not found\n",
                            grouped(agreement.only_cpu), grouped(agreement.only_cpu + agreement.both_hit));
    return text + folds + failures;
}

std::string stress_json(std::span<const StressCell> cells, uint64_t seed,
                        std::span<const std::string> no_skips) {
    std::string lines;
    for (const StressCell& cell : cells) lines += to_line(cell_json(cell, seed, no_skips)) + "\n";
    return lines;
}

void write_worst(const StressCell& cell, uint64_t seed, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(ExitCode::bad_input, "{}: cannot be made ({})", folder, error.message());
    for (const WorstPair& pair : cell.tally.worst) {
        const std::string stem =
            fmt::format("{}/{}.{}.{}.{}", folder, file_name(cell.family->name), file_name(cell.label),
                        file_name(device_text(cell.device)), pair.index);
        const std::vector<Curve> strand = make_strand(*cell.family, seed, pair.index);
        write_npy<Curve>(stem + ".curves.npy", {"<f4", {4, 4}}, strand);
        write_npy(stem + ".rays.npy", {"<f4", {8}}, &pair.ray, 1);
    }
}

}  // namespace strandlab
