#include "report/html/sections.h"
#include "report/result_json.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <unordered_map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// Texts that are written once, and numbers for them.
class Dictionary {
  public:
    size_t number_of(const std::string& text) {
        const auto [found, is_new] = numbers_.emplace(text, texts_.size());
        if (is_new) texts_.push_back(text);
        return found->second;
    }
    Json texts() const { return texts_; }

  private:
    std::unordered_map<std::string, size_t> numbers_;
    std::vector<std::string> texts_;
};

struct Column {
    const char* heading;
    const char* unit;
    const char* help;
    std::function<std::string(const Json&)> text;  // one of the two
    std::function<double(const Json&)> number;
};

Column text_column(const char* heading, const char* path, const char* help = "") {
    return {heading, "", help, [path](const Json& row) { return text_at(row, path); }, {}};
}

Column number_column(const char* heading, const char* unit, const char* path, double factor = 1,
                     const char* help = "") {
    return {heading, unit, help, {}, [path, factor](const Json& row) {
                return factor * number_or_nan(row, path);
            }};
}

/// Bytes per curve of a part of the memory.
Column bytes_column(const char* heading, const char* path, const char* help) {
    return {heading, "B/curve", help, {}, [path](const Json& row) {
                return number_or_nan(row, path) / number_or_nan(row, "model.curves");
            }};
}

/// A share of rays in per cent.
Column share_column(const char* heading, const std::string& path, const char* help) {
    return {heading, "%", help, {}, [path](const Json& row) {
                const double trials = number_or_nan(row, path + ".trials");
                return trials > 0 ? 100 * number_or_nan(row, path + ".count") / trials : std::nan("");
            }};
}

double spread_of(const Json& row) {
    const auto time = [&](const char* key) {
        return number_or_nan(row, std::string("time.trace_ms.") + key);
    };
    return 50 * (time("p95") - time("p5")) / time("median");
}

/// A figure of the picture at the camera's own distance.
double nearest_picture(const Json& row, const char* figure) {
    const Json* list = field_at(row, "distances");
    if (!list || !list->is_array()) return std::nan("");
    for (const Json& picture : *list)
        if (number_at(picture, "scale") == 1.0) return number_or_nan(picture, figure);
    return std::nan("");
}

double own_wrong_rays(const Json& row) {
    double wrong = 0;
    for (const char* outcome : {"nan", "false_hit", "false_miss", "wrong_strand", "wrong_place"})
        wrong += number_or_nan(row, fmt::format("intersector_error.decisive.{}.count", outcome));
    return number_or_nan(row, "intersector_error.decisive.rays") > 0 ? wrong : std::nan("");
}

std::vector<Column> columns() {
    const std::string all = "model_error.all.";
    return {
        {"primitive",
         "",
         "with its parameters; in brackets its strand ends where it cannot close them as the scene asks",
         row_label,
         {}},
        text_column("scene", "model.name"),
        text_column("rays", "rays.name"),
        text_column("resolution", "rays.resolution"),
        {"device",
         "",
         "",
         [](const Json& row) { return short_device_name(text_at(row, "device.name")); },
         {}},
        text_column("traversal", "device.class"),
        {"trace", "ms", "median of the samples", {}, row_time},
        {"±", "%", "half the distance from the 5th to the 95th percentile", {}, spread_of},
        number_column("speed", "Mrays/s", "time.mrays_per_second"),
        number_column("ratio", "", "time.ratio.median", 1, "to the baseline primitive, round by round"),
        number_column("build", "ms", "time.build_ms"),
        bytes_column("memory", "memory.resident_bytes", "what stays while tracing"),
        bytes_column("input", "memory.input_bytes", "needed by the build only"),
        bytes_column("structure", "memory.kept_bytes", "acceleration structure, after compaction"),
        bytes_column("records", "memory.record_bytes", "what the intersector reads"),
        {"wrong",
         "%",
         "of the rays that meet hair: false hit, false miss, other strand, other place, NaN",
         {},
         [](const Json& row) { return 100 * row_error(row).wrong_share; }},
        share_column("false hit", all + "false_hit", "of the rays that miss the curves"),
        share_column("false miss", all + "false_miss", "of the rays that hit the curves"),
        share_column("strand", all + "wrong_strand", "another one, of the rays that hit the curves"),
        number_column("dt p50", "radii", "model_error.all.distance.p50"),
        number_column("dt p99", "radii", "model_error.all.distance.p99"),
        number_column("dt max", "radii", "model_error.all.distance.max"),
        number_column("normal p99", "deg", "model_error.all.normal.p99"),
        {"own wrong",
         "rays",
         "decisive rays that are wrong about the primitive's own surface",
         {},
         own_wrong_rays},
        number_column("own dt p99", "radii", "intersector_error.decisive.distance.p99"),
        {"FLIP",
         "",
         "of converged pictures against the curves, at the picture's own distance",
         {},
         [](const Json& row) { return nearest_picture(row, "flip"); }},
        {"coverage",
         "%",
         "bias: how much more or less the hair covers than the curves do, in that picture",
         {},
         [](const Json& row) { return 100 * nearest_picture(row, "coverage_bias"); }},
        number_column("leaves", "/ray", "profile.work.leaves_per_ray", 1,
                      "that a ray enters, counted by instrumented shaders in a trace of its own"),
        number_column("false entries", "%", "profile.work.false_entry_share", 100,
                      "of these, without a hit there that is nearer than the one before"),
        number_column("iterations", "/ray", "profile.work.iterations_per_ray", 1,
                      "of the intersector's searches: cones or capsules tried, steps of refinement"),
        {"floor",
         "",
         "time with an intersector that always misses, relative to the trace: what of it is traversal",
         {},
         [](const Json& row) {
             return number_or_nan(row, "profile.floor_ms") / number_or_nan(row, "profile.trace_ms");
         }},
        number_column("undecided", "%", "intersector_error.undecided_share", 100,
                      "rays whose answer hangs on a thousandth of a radius"),
    };
}

/// Four digits; null for NaN.
Json short_number(double value) {
    if (std::isnan(value)) return {};
    if (std::isinf(value)) return json_number(value);
    return Json::parse(fmt::format("{:.4g}", value));
}

Json column_data(const Column& column, std::span<const Json> rows) {
    Json object{{"heading", column.heading}, {"unit", column.unit}, {"help", column.help}};
    Json values = Json::array();
    if (column.text) {
        Dictionary texts;
        for (const Json& row : rows) values.push_back(texts.number_of(column.text(row)));
        object["texts"] = texts.texts();
    } else {
        for (const Json& row : rows) values.push_back(short_number(column.number(row)));
    }
    object["values"] = std::move(values);
    return object;
}

/// Commands as numbers of their words: those of a sweep differ in few.
Json command_data(std::span<const Json> rows) {
    Dictionary words;
    Json commands = Json::array();
    for (const Json& row : rows) {
        const std::string command = text_at(row, "reproduce");
        Json numbers = Json::array();
        for (size_t begin = 0; !command.empty() && begin <= command.size();) {
            const size_t end = std::min(command.find(' ', begin), command.size());
            numbers.push_back(words.number_of(command.substr(begin, end - begin)));
            begin = end + 1;
        }
        commands.push_back(std::move(numbers));
    }
    return {{"words", words.texts()}, {"commands", std::move(commands)}};
}

Json mark_data(const std::vector<FrontMarks>& marks) {
    Json bits = Json::array();
    for (const FrontMarks& mark : marks)
        bits.push_back(mark.time_error + 2 * mark.memory_error + 4 * mark.time_wrong + 8 * mark.memory_wrong);
    return bits;
}

}  // namespace

std::string table_data(const PageData& data) {
    const std::vector<Json>& rows = data.results.rows;
    Json object{{"rows", rows.size()}};
    for (const Column& column : columns()) {
        Json values = column_data(column, rows);
        const auto is_empty = [](const Json& value) { return value.is_null(); };
        const bool nothing = std::all_of(values["values"].begin(), values["values"].end(), is_empty);
        if (!nothing) object["columns"].push_back(std::move(values));
    }
    for (const Json& row : rows) object["series"].push_back(series_of(row));
    object["fronts"] = mark_data(data.marks);
    object["reproduce"] = command_data(rows);
    Dictionary texts;
    Json warnings = Json::array();
    for (const Json& row : rows) warnings.push_back(texts.number_of(text_at(row, "time.warning")));
    object["warnings"] = {{"texts", texts.texts()}, {"values", std::move(warnings)}};
    return to_line(object);
}

}  // namespace strandlab
