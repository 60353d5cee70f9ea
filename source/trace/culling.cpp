#include "trace/culling.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "trace/reach.h"
#include "trace/reach_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

/// By how much a transform makes lengths grow, at most: the root of a norm of its square.
double stretch_of(const glm::mat4x3& world_from_object) {
    const glm::dmat3 m(world_from_object), square = glm::transpose(m) * m;
    double norm = 0;
    for (int column = 0; column < 3; ++column)
        norm = std::max(norm,
                        std::abs(square[column].x) + std::abs(square[column].y) + std::abs(square[column].z));
    return std::sqrt(norm);
}

/// Largest stretch of each model's instances.
std::vector<double> stretches(const Scene& scene) {
    std::vector<double> stretch(scene.models.size());
    for (const SceneInstance& instance : scene.instances)
        stretch[instance.model] = std::max(stretch[instance.model], stretch_of(instance.world_from_object));
    return stretch;
}

std::vector<uint8_t> strands_too_small(const Curves& curves, double stretch, double detail) {
    std::vector<uint8_t> is_small(curves.strands.size());
    parallel_for(is_small.size(), [&](size_t s) {
        const StrandRange& strand = curves.strands[s];
        const Box box = hull_box(std::span(curves.curves).subspan(strand.first, strand.count));
        is_small[s] =
            box.is_empty() || stretch * glm::length(glm::dvec3(box.high) - glm::dvec3(box.low)) < detail;
    });
    return is_small;
}

/// The strands of a model that are to keep, and the numbers of their curves from first_number on. The others
/// stay as empty strands, so that no strand gets another number: primitives may draw random numbers by it.
Curves kept_strands(const Curves& all, const std::vector<uint8_t>& keep, uint32_t first_number,
                    std::vector<uint32_t>& numbers) {
    Curves kept;
    kept.strands.resize(keep.size());
    uint32_t count = 0;
    for (size_t s = 0; s < keep.size(); ++s) {
        kept.strands[s] = {count, keep[s] != 0 ? all.strands[s].count : 0};
        count += kept.strands[s].count;
    }
    kept.curves.resize(count);
    const size_t before = numbers.size();
    numbers.resize(before + count);
    parallel_for(keep.size(), [&](size_t s) {
        const StrandRange from = all.strands[s], to = kept.strands[s];
        std::copy_n(all.curves.begin() + from.first, to.count, kept.curves.begin() + to.first);
        for (uint32_t k = 0; k < to.count; ++k)
            numbers[before + to.first + k] = first_number + from.first + k;
    });
    return kept;
}

}  // namespace

std::string Culling::to_string() const {
    std::string text = reach ? "reach" : "";
    if (detail > 0) text += fmt::format("{}detail={}", reach ? "," : "", detail);
    return text;
}

Culling parse_culling(std::string_view text) {
    constexpr std::string_view key = "detail=";
    Culling culling;
    for (const std::string_view part : split(text, ',')) {
        if (part == "reach") {
            culling.reach = true;
            continue;
        }
        const auto length = part.starts_with(key) ? to_number(part.substr(key.size())) : std::nullopt;
        const float detail = length ? static_cast<float>(*length) : 0;
        if (!(detail > 0) || !std::isfinite(detail))
            fail(ExitCode::usage, "--cull {}: must be reach, detail=LENGTH (above 0) or both as {}",
                 one_line(text), "reach,detail=LENGTH");
        culling.detail = detail;
    }
    return culling;
}

CulledScene cull(const Scene& scene, const Culling& culling, std::span<const Ray> rays) {
    const Stopwatch stopwatch;
    CulledScene culled;
    culled.scene.name = scene.name;
    culled.scene.instances = scene.instances;
    culled.scene.occluder = scene.occluder;
    if (culling.detail > 0) culled.is_too_small.resize(scene.curve_count());
    const std::vector<double> stretch = stretches(scene);
    std::vector<std::vector<uint8_t>> reached;
    if (culling.reach) reached = strands_within_reach(scene, rays);
    std::vector<uint32_t> numbers;
    for (uint32_t m = 0; m < scene.models.size(); ++m) {
        const Curves& all = scene.models[m];
        const uint32_t first = scene.first_curve(m);
        std::vector<uint8_t> small, keep(all.strands.size(), 1);
        if (culling.detail > 0) small = strands_too_small(all, stretch[m], double(culling.detail));
        for (size_t s = 0; s < keep.size(); ++s) {
            const bool is_small = !small.empty() && small[s] != 0;
            keep[s] = !is_small && (!culling.reach || reached[m][s] != 0);
            if (keep[s] != 0) continue;
            const StrandRange& strand = all.strands[s];
            StrandCount& count = is_small ? culled.too_small : culled.out_of_reach;
            ++count.strands;
            count.curves += strand.count;
            if (is_small) std::fill_n(culled.is_too_small.begin() + first + strand.first, strand.count, 1);
        }
        culled.scene.models.push_back(kept_strands(all, keep, first, numbers));
    }
    culled.curve_numbers = std::make_shared<const std::vector<uint32_t>>(std::move(numbers));
    culled.milliseconds = stopwatch.milliseconds();
    return culled;
}

void remove_too_small(Surface& surface, const CulledScene& culled, uint32_t first_curve) {
    if (culled.too_small.strands == 0) return;
    const auto is_gone = [&](const auto& part) { return culled.is_too_small[first_curve + part.curve] != 0; };
    std::erase_if(surface.pieces, is_gone);
    std::erase_if(surface.triangles, is_gone);
}

}  // namespace strandlab
