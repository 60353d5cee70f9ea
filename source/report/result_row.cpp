#include "report/result_row.h"

#include <fmt/format.h>

#include <utility>

namespace strandlab {

ModelFacts facts_of(std::string name, const Curves& curves, size_t instances) {
    return {std::move(name), hash(curves), curves.curves.size(), curves.strands.size(), instances};
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
    return {info.name,        info.driver, info.api_version, info.kind, info.has_ray_tracing_hardware,
            validation_layers};
}

std::optional<Summary> ResultRow::trace_time() const {
    const Summary summary = summarise(trace_ms, seed);
    return summary.count > 0 ? std::optional(summary) : std::nullopt;
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

std::optional<double> ResultRow::bytes_per_curve() const {
    const auto bytes = resident_bytes();
    if (!bytes || model.curves == 0) return std::nullopt;
    return static_cast<double>(*bytes) / static_cast<double>(model.curves);
}

std::string ResultRow::key() const {
    return fmt::format("{} {:016x} x{} | {} {:016x} | {} caps={} | {} | seed={}", model.name, model.hash,
                       model.instances, rays.name, rays.hash, primitive.label, name_of(primitive.caps),
                       device.name, seed);
}

}  // namespace strandlab
