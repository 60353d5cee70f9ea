#include "report/result_row.h"

#include <fmt/format.h>

#include <utility>

namespace strandlab {

ModelFacts facts_of(std::string name, const Curves& curves, size_t instances) {
    return {std::move(name), hash(curves), curves.curves.size(), curves.strands.size(), instances, {}};
}

RayFacts facts_of(const Rays& rays, uint32_t samples) {
    RayFacts facts{rays.name, rays.rays.size(), hash(rays), rays.width, rays.height, samples};
    // The samples of a pixel lie side by side in the launch.
    if (samples > 1) facts.width /= samples;
    return facts;
}

PrimitiveFacts facts_of(const PrimitiveChoice& choice, Caps wanted_caps) {
    PrimitiveFacts facts{choice.primitive->name, choice.label(), {}, choice.options.caps, wanted_caps};
    for (const auto& info : choice.primitive->parameters)
        facts.parameters.emplace_back(info.name, choice.options.parameters.text(info.name));
    return facts;
}

DeviceFacts facts_of(const DeviceInfo& info, bool validation_layers) {
    return {info.name,         info.driver, info.api_version, info.kind, info.has_ray_tracing_hardware,
            validation_layers, info.memory};
}

std::string BenchSettings::key() const {
    std::string text;
    if (leaf_order != "auto") text += " order=" + leaf_order;
    if (!compaction) text += " compaction=0";
    if (!normals) text += " normals=0";
    if (low_memory) text += " low_memory=1";
    if (traversal != "pipeline") text += " traversal=" + traversal;
    if (bytes_per_curve > 0) text += fmt::format(" bytes_per_curve={}", bytes_per_curve);
    if (!cull.empty()) text += " cull=" + cull;
    for (const std::string& skip : no_skips) text += " no_skip=" + skip;
    return text;
}

namespace {

std::optional<Summary> summary_of(const std::vector<double>& samples, uint64_t seed) {
    const Summary summary = summarise(samples, seed);
    return summary.count > 0 ? std::optional(summary) : std::nullopt;
}

}  // namespace

std::optional<Summary> ResultRow::trace_time() const { return summary_of(trace_ms, seed); }
std::optional<Summary> ResultRow::wall_time() const { return summary_of(wall_ms, seed); }

std::optional<Summary> ResultRow::ratio_summary() const {
    return ratio ? summary_of(ratio->samples, seed) : std::nullopt;
}

std::optional<double> ResultRow::spread() const {
    const auto time = trace_time();
    if (!time || time->count < 2 || !(time->median > 0)) return std::nullopt;
    return (time->p95 - time->p5) / (2 * time->median);
}

std::string ResultRow::warning() const {
    constexpr double wide = 0.1;
    const auto width = spread();
    if (!width || *width <= wide) return "";
    const char* advice =
        device.kind == "cpu"
            ? "close other programs, give --threads fewer cores than there are, or raise --repeat"
            : "lock the clocks (nvidia-smi -lgc), close other programs, or raise --repeat";
    return fmt::format("samples spread by +-{:.0f} %: {}", 100 * *width, advice);
}

std::optional<double> ResultRow::mrays_per_second() const {
    const auto time = trace_time();
    if (!time || !(time->median > 0)) return std::nullopt;
    return static_cast<double>(rays.count) / time->median / 1e3;
}

std::optional<uint64_t> ResultRow::resident_bytes() const {
    if (!cost) return std::nullopt;
    return cost->builds.kept_bytes + cost->record_bytes;
}

std::optional<uint64_t> ResultRow::buffer_bytes() const {
    if (!cost) return std::nullopt;
    return cost->builds.input_bytes + cost->record_bytes;
}

std::optional<double> ResultRow::bytes_per_curve() const {
    const auto bytes = resident_bytes();
    if (!bytes || model.curves == 0) return std::nullopt;
    return static_cast<double>(*bytes) / static_cast<double>(model.curves);
}

std::string ResultRow::key() const {
    return fmt::format("{} {:016x} x{} | {} {:016x} | {} caps={} | {} | seed={}{}", model.name, model.hash,
                       model.instances, rays.name, rays.hash, primitive.label, name_of(primitive.caps),
                       device.name, seed, settings.key());
}

}  // namespace strandlab
