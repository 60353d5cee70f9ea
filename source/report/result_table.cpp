#include "report/result_table.h"

#include "report/fronts.h"
#include "report/row_fields.h"
#include "report/table.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string number(std::optional<double> value, int digits = 3, double factor = 1) {
    return value ? significant(*value * factor, digits) : "-";
}

std::string number(const Json& row, std::string_view path, int digits = 3, double factor = 1) {
    return number(number_at(row, path), digits, factor);
}

uint64_t count(const Json& row, const std::string& path) {
    return static_cast<uint64_t>(number_at(row, path).value_or(0));
}

/// Percentage of a class of errors among the rays where it could be.
std::string share(const Json& row, const std::string& path) {
    const uint64_t trials = count(row, path + ".trials");
    return trials == 0 ? "-" : significant(100 * double(count(row, path + ".count")) / double(trials), 2);
}

std::string bytes_per_curve(const Json& row, std::string_view path) {
    const uint64_t curves = count(row, "model.curves");
    return curves == 0 ? "-" : number(row, path, 3, 1 / double(curves));
}

/// Decisive rays on which the primitive is wrong about its own surface.
std::string own_errors(const Json& row) {
    const std::string tally = "intersector_error.decisive.";
    if (count(row, tally + "rays") == 0) return "-";
    uint64_t wrong = 0;
    for (const char* outcome : {"nan", "false_hit", "false_miss", "wrong_strand", "wrong_place"})
        wrong += count(row, tally + outcome + ".count");
    return fmt::format("{}", wrong);
}

std::string front_text(const FrontMarks& marks) {
    return std::string(marks.time_error ? "T" : "") + (marks.memory_error ? "M" : "");
}

std::vector<std::string> cells(const Json& row, const FrontMarks& marks) {
    std::string caps = text_at(row, "primitive.caps");
    if (is_true_at(row, "primitive.caps_fell_back")) caps += "*";
    const std::string model = "model_error.all.", own = "intersector_error.decisive.";
    return {
        text_at(row, "primitive.label"),
        caps,
        front_text(marks),
        number(row, "time.trace_ms.median", 4),
        number(row, "time.spread", 2, 100),
        number(row, "time.ratio.median", 3),
        number(row, "time.mrays_per_second"),
        number(row, "time.build_ms"),
        number(row, "memory.bytes_per_curve"),
        bytes_per_curve(row, "memory.input_bytes"),
        bytes_per_curve(row, "memory.built_bytes"),
        bytes_per_curve(row, "memory.kept_bytes"),
        bytes_per_curve(row, "memory.record_bytes"),
        share(row, model + "false_hit"),
        share(row, model + "false_miss"),
        share(row, model + "wrong_strand"),
        field_at(row, "model_error") != nullptr ? grouped(count(row, "model_error.inside_own.rays")) : "-",
        number(row, model + "distance.p50", 2),
        number(row, model + "distance.p99", 2),
        number(row, model + "normal.p99", 2),
        own_errors(row),
        number(row, own + "distance.p99", 2)};
}

Table empty_table() {
    return Table({{"primitive", "", true}, {"caps", "", true},    {"front", "", true},
                  {"trace", "ms"},         {"+-", "%"},           {"ratio"},
                  {"speed", "Mrays/s"},    {"build", "ms"},       {"memory", "B/curve"},
                  {"input", "B/curve"},    {"tree", "B/curve"},   {"kept", "B/curve"},
                  {"records", "B/curve"},  {"false hit", "%"},    {"false miss", "%"},
                  {"strand", "%"},         {"in own", "rays"},    {"dt p50", "radii"},
                  {"dt p99", "radii"},     {"normal p99", "deg"}, {"own wrong", "rays"},
                  {"own dt p99", "radii"}});
}

std::string heading(const Json& first, const Json* measured) {
    std::string text =
        fmt::format("{}: {} strands, {} curves; {} {} rays", text_at(first, "model.name"),
                    grouped(count(first, "model.strands")), grouped(count(first, "model.curves")),
                    grouped(count(first, "rays.count")), text_at(first, "rays.name"));
    if (measured == nullptr) return text;
    const auto rays = [&](const char* group) {
        return count(*measured, fmt::format("model_error.{}.rays", group));
    };
    const uint64_t all = rays("all") + rays("on_cap") + rays("inside") + rays("inside_own");
    return text + fmt::format("; errors of {} of them ({} decisive, {} start inside, {} on caps)",
                              grouped(all), percent(all ? double(rays("decisive")) / double(all) : 0),
                              grouped(rays("inside")), grouped(rays("on_cap")));
}

/// Rows of one model and ray set stand in one table, on whichever device.
std::string table_key(const Json& row) {
    return Json{text_at(row, "model.hash"), text_at(row, "model.name"), text_at(row, "rays.hash"),
                text_at(row, "rays.name"), number_at(row, "model.instances").value_or(1)}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string result_table(std::span<const Json> rows) {
    const std::vector<FrontMarks> marks = pareto_fronts(rows);
    std::vector<std::string> order;
    std::map<std::string, std::vector<size_t>> groups;
    for (size_t i = 0; i < rows.size(); ++i) {
        const std::string key = table_key(rows[i]);
        if (!groups.contains(key)) order.push_back(key);
        groups[key].push_back(i);
    }
    std::string text;
    for (const std::string& key : order) {
        const std::vector<size_t>& members = groups[key];
        const auto measured = std::find_if(members.begin(), members.end(), [&](size_t i) {
            return field_at(rows[i], "model_error") != nullptr;
        });
        Table table = empty_table();
        for (const size_t i : members) table.add_row(cells(rows[i], marks[i]));
        if (!text.empty()) text += "\n";
        text += heading(rows[members.front()], measured == members.end() ? nullptr : &rows[*measured]) +
                "\n" + table.to_string(standard_output_style());
    }
    return text;
}

std::string result_legend() {
    return R"(front: T, no other row here is faster and less wrong; M, none is smaller and less wrong (dt p99; over 1 %
of wrong rays count as infinitely wrong). ratio: to the baseline primitive, round by round.
memory: what stays while tracing = kept (acceleration structure after compaction) + records.
false hit, false miss, strand (another one), dt, normal: against the exact swept sphere of the curves
(model error: shape, rounding and intersector together). own: decisive rays that are wrong about the
primitive's own surface, and dt there (intersector error). in own: rays that start inside that surface,
judged apart. caps*: the primitive cannot do the scene's.
)";
}

}  // namespace strandlab
