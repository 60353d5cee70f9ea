#include "report/result_json.h"

#include "base/error.h"
#include "base/log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <limits>

namespace strandlab {

using Json = nlohmann::ordered_json;

Json json_number(double value) {
    if (std::isfinite(value)) return value;
    if (std::isnan(value)) return "nan";
    return value > 0 ? "inf" : "-inf";
}

std::optional<double> number_of(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (value == "inf") return std::numeric_limits<double>::infinity();
    if (value == "-inf") return -std::numeric_limits<double>::infinity();
    return std::nullopt;
}

namespace {

Json optional_number(const std::optional<double>& value) { return value ? json_number(*value) : Json(); }

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json hash_text(uint64_t hash) { return fmt::format("{:016x}", hash); }

Json to_json(const Count& count) {
    const Interval bounds = count.bounds();
    Json object{{"count", count.count}, {"trials", count.trials}, {"low", bounds.low}, {"high", bounds.high}};
    object["first_ray"] = count.first_ray == Count::no_ray ? Json() : Json(count.first_ray);
    return object;
}

/// Null when the measure exists for no ray.
Json to_json(const Percentiles& p) {
    if (p.count == 0) return {};
    return {{"count", p.count},          {"p50", json_number(p.p50)},   {"p95", json_number(p.p95)},
            {"p99", json_number(p.p99)}, {"p999", json_number(p.p999)}, {"max", json_number(p.max)},
            {"worst_ray", p.worst_ray},  {"decades", p.decades}};
}

Json to_json(const Tally& tally) {
    Json object{{"rays", tally.rays},
                {"agreed_misses", tally.agreed_misses},
                {"matches", tally.matches},
                {"nan", to_json(tally.nan)},
                {"false_hit", to_json(tally.false_hit)},
                {"false_miss", to_json(tally.false_miss)},
                {"wrong_strand", to_json(tally.wrong_strand)},
                {"wrong_place", to_json(tally.wrong_place)},
                {"bad_normal", to_json(tally.bad_normal)}};
    for (size_t i = 0; i < measure_count; ++i)
        object[std::string(measure_infos[i].name)] = to_json(tally.measures[i]);
    return object;
}

Json to_json(const Summary& s) {
    return {{"median", s.median},
            {"low", s.median_bounds.low},
            {"high", s.median_bounds.high},
            {"mad", s.mad},
            {"p5", s.p5},
            {"p95", s.p95},
            {"min", s.min},
            {"max", s.max}};
}

Json to_json(const SweepFacts& sweep) {
    const SweepAxes none;
    const SweepAxes& axes = sweep.axes ? *sweep.axes : none;
    return {
        {"id", hash_text(sweep.id)},       {"case", sweep.number},        {"cases", axes.cases()},
        {"shard", sweep.shard.index},      {"shards", sweep.shard.count}, {"models", axes.models},
        {"resolutions", axes.resolutions}, {"rays", axes.rays},           {"primitives", axes.primitives}};
}

Json to_json(const CaseFiles& images) {
    if (images.rendered.empty()) return {};
    return {{"rendered", text_or_null(images.rendered)},
            {"reference", text_or_null(images.reference)},
            {"error_map", text_or_null(images.error_map)}};
}

Json to_json(const DistantError& error) {
    return {{"scale", error.scale},
            {"rays", error.rays},
            {"coverage", error.detail.coverage},
            {"coverage_bias", error.detail.coverage_bias},
            {"coverage_rms", error.detail.coverage_rms},
            {"depth_bias", optional_number(error.depth_bias)},
            {"transmittance", error.detail.transmittance},
            {"transmittance_bias", error.detail.transmittance_bias},
            {"flip", error.flip}};
}

Json to_json(const std::vector<DistantError>& errors) {
    if (errors.empty()) return {};
    Json list = Json::array();
    for (const DistantError& error : errors) list.push_back(to_json(error));
    return list;
}

Json to_json(const BenchSettings& settings) {
    return {{"repeat", settings.repeat},
            {"warm_up_ms", json_number(settings.warm_up_ms)},
            {"error_rays", settings.error_rays},
            {"leaf_order", settings.leaf_order},
            {"compaction", settings.compaction},
            {"normals", settings.normals},
            {"low_memory", settings.low_memory},
            {"traversal", settings.traversal},
            {"no_skips", settings.no_skips},
            {"caps", name_of(settings.caps)},
            {"bytes_per_curve", json_number(settings.bytes_per_curve)},
            {"cull", text_or_null(settings.cull)},
            {"left_out_strands", settings.left_out ? Json(settings.left_out->strands) : Json()},
            {"left_out_curves", settings.left_out ? Json(settings.left_out->curves) : Json()}};
}

Json to_json(const ModelFacts& model) {
    return {{"name", model.name},       {"hash", hash_text(model.hash)}, {"curves", model.curves},
            {"strands", model.strands}, {"instances", model.instances},  {"spec", model.spec}};
}

Json to_json(const RayFacts& rays) {
    return {{"name", rays.name},
            {"kind", rays.kind},
            {"shuffled", rays.shuffled},
            {"as_shadow", rays.as_shadow},
            {"seed", rays.seed},
            {"count", rays.count},
            {"hash", hash_text(rays.hash)},
            {"width", rays.width},
            {"height", rays.height},
            {"samples", rays.samples},
            {"resolution", rays.resolution},
            {"camera", text_or_null(rays.camera)}};
}

Json to_json(const PrimitiveFacts& primitive) {
    Json parameters = Json::object();
    for (const auto& [name, value] : primitive.parameters) parameters[name] = value;
    return {{"name", primitive.name},
            {"label", primitive.label},
            {"parameters", parameters},
            {"caps", name_of(primitive.caps)},
            {"wanted_caps", name_of(primitive.wanted_caps)},
            {"caps_fell_back", primitive.caps_fell_back()}};
}

Json to_json(const DeviceFacts& device) {
    return {{"name", device.name},
            {"driver", device.driver},
            {"api_version", device.api_version},
            {"kind", device.kind},
            {"class", device.device_class()},
            {"ray_tracing_hardware", device.hardware_traversal},
            {"memory_bytes", device.memory_bytes},
            {"validation_layers", device.validation_layers}};
}

Json numbers(const std::vector<double>& values) {
    Json array = Json::array();
    for (const double value : values) array.push_back(json_number(value));
    return array;
}

Json ratio_of(const ResultRow& row) {
    const auto summary = row.ratio_summary();
    if (!summary) return {};
    return {{"baseline", row.ratio->baseline},
            {"median", summary->median},
            {"low", summary->median_bounds.low},
            {"high", summary->median_bounds.high},
            {"samples", numbers(row.ratio->samples)}};
}

Json time_of(const ResultRow& row) {
    const auto trace = row.trace_time(), wall = row.wall_time();
    const auto of_cost = [&](auto&& value) { return row.cost ? json_number(value(*row.cost)) : Json(); };
    return {{"trace_ms", trace ? to_json(*trace) : Json()},
            {"spread", optional_number(row.spread())},
            {"warning", text_or_null(row.warning())},
            {"mrays_per_second", optional_number(row.mrays_per_second())},
            {"wall_ms", wall ? to_json(*wall) : Json()},
            {"ratio", ratio_of(row)},
            {"group", text_or_null(row.group)},
            {"cull_ms", optional_number(row.cull_ms)},
            {"geometry_ms", optional_number(row.geometry_ms)},
            {"order_ms", of_cost([](const SceneCost& c) { return c.order_ms; })},
            {"order_cached", row.cost ? Json(row.cost->order_cached) : Json()},
            {"traversal", row.cost ? Json(name_of(row.cost->traversal)) : Json()},
            {"upload_ms", of_cost([](const SceneCost& c) { return c.builds.upload_ms; })},
            {"build_ms", of_cost([](const SceneCost& c) { return c.builds.build_ms; })},
            {"compaction_ms", of_cost([](const SceneCost& c) { return c.builds.compaction_ms; })},
            {"pipeline_ms", of_cost([](const SceneCost& c) { return c.pipeline_ms; })},
            {"samples_ms", numbers(row.trace_ms)},
            {"wall_samples_ms", numbers(row.wall_ms)},
            {"positions", row.positions}};
}

Json memory_of(const ResultRow& row) {
    const auto of_cost = [&](auto&& value) { return row.cost ? Json(value(*row.cost)) : Json(); };
    return {{"leaves", of_cost([](const SceneCost& c) { return c.leaf_count; })},
            {"structures", of_cost([](const SceneCost& c) { return c.structure_count; })},
            {"input_bytes", of_cost([](const SceneCost& c) { return c.builds.input_bytes; })},
            {"scratch_bytes", of_cost([](const SceneCost& c) { return c.builds.scratch_bytes; })},
            {"built_bytes", of_cost([](const SceneCost& c) { return c.builds.built_bytes; })},
            {"kept_bytes", of_cost([](const SceneCost& c) { return c.builds.kept_bytes; })},
            {"record_bytes", of_cost([](const SceneCost& c) { return c.record_bytes; })},
            {"peak_bytes", of_cost([](const SceneCost& c) { return c.builds.peak_bytes; })},
            {"buffer_bytes", row.buffer_bytes() ? Json(*row.buffer_bytes()) : Json()},
            {"resident_bytes", row.resident_bytes() ? Json(*row.resident_bytes()) : Json()},
            {"bytes_per_curve", optional_number(row.bytes_per_curve())}};
}

Json to_json(const std::optional<WorkCounts>& work) {
    if (!work) return {};
    return {{"rays", work->rays},
            {"leaves_per_ray", json_number(work->leaves_per_ray())},
            {"false_entry_share", json_number(work->false_entry_share())},
            {"searched_share", json_number(work->searched_share())},
            {"iterations_per_ray", json_number(work->iterations_per_ray())},
            {"reports_per_ray", json_number(work->reports_per_ray())},
            {"most_leaves", work->most_leaves},
            {"most_iterations", work->most_iterations}};
}

/// Meanings: measure/trace_profile.h, trace/work_counts.h.
Json to_json(const TraceProfile& profile) {
    Json shaders = Json::array();
    for (const ShaderStatistic& one : profile.shaders)
        shaders.push_back({{"shader", one.shader}, {"name", one.name}, {"value", one.value}});
    return {{"hits", profile.hits},
            {"trace_ms", json_number(profile.trace_ms)},
            {"floor_ms", optional_number(profile.floor_ms)},
            {"floor_at_hit_ms", optional_number(profile.floor_at_hit_ms)},
            {"work", to_json(profile.work)},
            {"work_at_hit", to_json(profile.work_at_hit)},
            {"shaders", shaders}};
}

Json to_json(const Context& context) {
    return {{"version", context.version},   {"commit", context.commit},
            {"modified", context.modified}, {"compiler", context.compiler},
            {"flags", context.flags},       {"build_type", context.build_type},
            {"cpu", context.cpu},           {"cores", context.cores},
            {"threads", context.threads},   {"memory_bytes", context.memory_bytes},
            {"system", context.system},     {"shaders", hash_text(context.shaders)},
            {"time", context.time}};
}

}  // namespace

Json to_json(const Comparison& comparison) {
    return {{"hit_or_miss_only", comparison.hit_or_miss_only},
            {"margin", json_number(comparison.margin)},
            {"resolvable", comparison.is_resolvable()},
            {"undecided_share", comparison.undecided_share()},
            {"decisive", to_json(comparison.decisive)},
            {"all", to_json(comparison.all)},
            {"on_cap", to_json(comparison.on_cap)},
            {"inside", to_json(comparison.inside)},
            {"inside_own", to_json(comparison.inside_own)}};
}

Json to_json(const ResultRow& row) {
    return {{"schema", ResultRow::schema},
            {"command", row.command},
            {"key", row.key()},
            {"sweep", to_json(row.sweep)},
            {"reproduce", row.reproduce},
            {"model", to_json(row.model)},
            {"rays", to_json(row.rays)},
            {"primitive", to_json(row.primitive)},
            {"device", to_json(row.device)},
            {"settings", to_json(row.settings)},
            {"time", time_of(row)},
            {"memory", memory_of(row)},
            {"intersector_error", row.intersector_error ? to_json(*row.intersector_error) : Json()},
            {"model_error", row.model_error ? to_json(*row.model_error) : Json()},
            {"profile", row.profile ? to_json(*row.profile) : Json()},
            {"images", to_json(row.images)},
            {"distances", to_json(row.distances)},
            {"seed", row.seed},
            {"context", to_json(row.context)}};
}

std::string to_line(const Json& object) {
    return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void for_each_json_line(const std::string& path, const std::function<void(size_t line, Json& row)>& visit) {
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(ExitCode::bad_input, "{}: cannot open this result file", path);
    size_t number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        const bool is_complete = !file.eof();
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        bool too_deep = false;  // deeper than any row: what handles one recurses
        const auto stay_shallow = [&](int depth, Json::parse_event_t, const Json&) {
            too_deep = too_deep || depth > 64;
            return !too_deep;
        };
        Json row = Json::parse(line, stay_shallow, false);
        if (row.is_object() && !too_deep)
            visit(number, row);
        else if (!is_complete)
            warn("{}: line {} was cut off and is left out", path, number);
        else
            fail(ExitCode::bad_input,
                 "{}: line {} is not a JSON object; remove it or choose a file that bench wrote", path,
                 number);
    }
    if (file.bad()) fail(ExitCode::bad_input, "{}: cannot read beyond line {}", path, number);
}

std::vector<Json> read_json_lines(const std::string& path) {
    std::vector<Json> rows;
    for_each_json_line(path, [&](size_t, Json& row) { rows.push_back(std::move(row)); });
    return rows;
}

}  // namespace strandlab
