#include "commands/bench_table.h"

#include "report/table.h"
#include "report/text_format.h"

#include <fmt/format.h>

#include <algorithm>

namespace strandlab {
namespace {

std::string number(const std::optional<double>& value, int digits = 3) {
    return value ? significant(*value, digits) : "-";
}

std::string share(const Count& count) {
    return count.trials == 0 ? "-" : significant(100 * count.share(), 2);
}

/// Half the distance from the 5th to the 95th percentile, as a percentage of the median.
std::string spread(const std::optional<Summary>& time) {
    if (!time || time->count < 2 || !(time->median > 0)) return "-";
    return significant(50 * (time->p95 - time->p5) / time->median, 2);
}

std::string bytes_per_curve(const ResultRow& row, uint64_t bytes) {
    return row.model.curves == 0 ? "-" : significant(double(bytes) / double(row.model.curves), 3);
}

std::string caps_text(const PrimitiveFacts& primitive) {
    return std::string(name_of(primitive.caps)) + (primitive.caps_fell_back() ? "*" : "");
}

/// Decisive rays on which the primitive is wrong about its own surface.
std::string own_errors(const std::optional<Comparison>& error) {
    if (!error || error->decisive.rays == 0) return "-";
    const Tally& tally = error->decisive;
    return fmt::format("{}", tally.nan.count + tally.false_hit.count + tally.false_miss.count +
                                 tally.wrong_strand.count + tally.wrong_place.count);
}

std::vector<std::string> cells(const ResultRow& row) {
    const auto time = row.trace_time();
    std::vector<std::string> all = {row.primitive.label, caps_text(row.primitive),
                                    time ? significant(time->median, 4) : "-", spread(time),
                                    number(row.mrays_per_second())};
    if (row.cost) {
        const BuildCost& builds = row.cost->builds;
        all.insert(all.end(),
                   {significant(builds.build_ms, 3), number(row.bytes_per_curve()),
                    bytes_per_curve(row, builds.input_bytes), bytes_per_curve(row, builds.built_bytes),
                    bytes_per_curve(row, builds.kept_bytes), bytes_per_curve(row, row.cost->record_bytes)});
    } else {
        all.insert(all.end(), 6, "-");
    }
    if (row.model_error && row.model_error->all.rays > 0) {
        const Tally& tally = row.model_error->all;
        const Percentiles& distance = tally.of(Measure::distance);
        all.insert(all.end(),
                   {share(tally.false_hit), share(tally.false_miss), share(tally.wrong_strand),
                    distance.count ? significant(distance.p50, 2) : "-",
                    distance.count ? significant(distance.p99, 2) : "-",
                    tally.of(Measure::normal).count ? significant(tally.of(Measure::normal).p99, 2) : "-"});
    } else {
        all.insert(all.end(), 6, "-");
    }
    all.push_back(own_errors(row.intersector_error));
    const bool has_own =
        row.intersector_error && row.intersector_error->decisive.of(Measure::distance).count > 0;
    all.push_back(has_own ? significant(row.intersector_error->decisive.of(Measure::distance).p99, 2) : "-");
    return all;
}

}  // namespace

std::string bench_table(std::span<const ResultRow> rows) {
    if (rows.empty()) return "";
    const ResultRow& first = rows.front();
    std::string text =
        fmt::format("{}: {} strands, {} curves; {} {} rays", first.model.name, grouped(first.model.strands),
                    grouped(first.model.curves), grouped(first.rays.count), first.rays.name);
    const auto measured = std::find_if(rows.begin(), rows.end(), [](const ResultRow& row) {
        return row.model_error && row.model_error->rays() > 0;
    });
    if (measured != rows.end()) {
        const Comparison& error = *measured->model_error;
        text += fmt::format("; errors of {} of them ({} decisive, {} start inside, {} on caps)",
                            grouped(error.rays()),
                            percent(error.rays() ? double(error.decisive.rays) / double(error.rays()) : 0),
                            grouped(error.inside.rays), grouped(error.on_cap.rays));
    }
    Table table({{"primitive", "", true},
                 {"caps", "", true},
                 {"trace", "ms"},
                 {"+-", "%"},
                 {"speed", "Mrays/s"},
                 {"build", "ms"},
                 {"memory", "B/curve"},
                 {"input", "B/curve"},
                 {"tree", "B/curve"},
                 {"kept", "B/curve"},
                 {"records", "B/curve"},
                 {"false hit", "%"},
                 {"false miss", "%"},
                 {"strand", "%"},
                 {"dt p50", "radii"},
                 {"dt p99", "radii"},
                 {"normal p99", "deg"},
                 {"own wrong", "rays"},
                 {"own dt p99", "radii"}});
    for (const ResultRow& row : rows) table.add_row(cells(row));
    return text + "\n" + table.to_string(standard_output_style());
}

std::string bench_legend() {
    return "memory: what stays while tracing = kept (acceleration structure after compaction) + records.\n"
           "false hit, false miss, strand (another one), dt, normal: against the exact swept sphere of the "
           "curves\n"
           "(model error: shape, rounding and intersector together). own: decisive rays that are wrong about "
           "the\n"
           "primitive's own surface, and dt there (intersector error). caps*: the primitive cannot do the "
           "scene's.\n";
}

}  // namespace strandlab
