#include "report/comparison_text.h"

#include "report/text_format.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace strandlab {
namespace {

struct NamedTally {
    const char* name;
    const Tally* tally;
};

struct NamedCount {
    const char* name;
    Count Tally::*count;
};

constexpr NamedCount classes[] = {
    {"false hit", &Tally::false_hit},       {"false miss", &Tally::false_miss},
    {"wrong strand", &Tally::wrong_strand}, {"wrong place", &Tally::wrong_place},
    {"not a number", &Tally::nan},          {"bad normal", &Tally::bad_normal}};

}  // namespace

std::string count_text(const Count& count) {
    if (count.trials == 0) return "-";
    const Interval bounds = count.bounds();
    const std::string head = fmt::format("{} of {}", grouped(count.count), grouped(count.trials));
    if (count.count == 0) return fmt::format("{} (95 %: below {})", head, percent(bounds.high));
    if (count.count == count.trials) return fmt::format("{} (95 %: above {})", head, percent(bounds.low));
    return fmt::format("{} ({}, 95 %: {} to {})", head, percent(count.share()), percent(bounds.low),
                       percent(bounds.high));
}

Table outcome_table(const Comparison& comparison) {
    std::vector<Column> columns{{.heading = "outcome", .text = true}};
    std::vector<NamedTally> groups;
    for (const NamedTally& group :
         {NamedTally{"decisive", &comparison.decisive}, NamedTally{"all", &comparison.all},
          NamedTally{"on a cap", &comparison.on_cap}, NamedTally{"starts inside", &comparison.inside},
          NamedTally{"starts inside own", &comparison.inside_own}}) {
        if (group.tally->rays == 0) continue;
        groups.push_back(group);
        columns.push_back({.heading = group.name, .unit = {}});
    }
    Table table(std::move(columns));
    const auto add = [&](const char* name, auto&& text_of) {
        std::vector<std::string> cells{name};
        for (const NamedTally& group : groups) cells.push_back(text_of(*group.tally));
        table.add_row(std::move(cells));
    };
    add("rays", [](const Tally& tally) { return grouped(tally.rays); });
    add("agreed hits", [](const Tally& tally) { return grouped(tally.matches); });
    add("agreed misses", [](const Tally& tally) { return grouped(tally.agreed_misses); });
    for (const NamedCount& item : classes)
        add(item.name, [&](const Tally& tally) { return count_text(tally.*item.count); });
    return table;
}

Table measure_table(const Comparison& comparison) {
    Table table({{.heading = "measure", .text = true},
                 {.heading = "unit", .text = true},
                 {.heading = "50 %"},
                 {.heading = "95 %"},
                 {.heading = "99 %"},
                 {.heading = "99.9 %"},
                 {.heading = "max"},
                 {.heading = "worst ray"}});
    for (size_t i = 0; i < measure_count; ++i) {
        const Percentiles& p = comparison.decisive.measures[i];
        if (p.count == 0) continue;
        table.add_row({std::string(measure_infos[i].name), std::string(measure_infos[i].unit),
                       significant(p.p50), significant(p.p95), significant(p.p99), significant(p.p999),
                       significant(p.max), std::to_string(p.worst_ray)});
    }
    return table;
}

std::string comparison_text(const Comparison& comparison, const TableStyle& style) {
    std::string text = outcome_table(comparison).to_string(style);
    const Table measures = measure_table(comparison);
    if (!measures.is_empty()) text.append("\n").append(measures.to_string(style));
    text += fmt::format("\nundecided: {} of {} ({}); radii scaled by 1 +- {}\n",
                        grouped(comparison.undecided()), grouped(comparison.all.rays),
                        percent(comparison.undecided_share()), significant(comparison.margin));
    if (!comparison.is_resolvable())
        text += fmt::format("no verdict: the margin is above {}, the surface is too thin for its distance\n",
                            significant(Comparison::largest_margin));
    return text;
}

}  // namespace strandlab
