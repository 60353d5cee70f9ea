#include "report/sweep.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/text.h"

#include <cassert>
#include <cmath>

namespace strandlab {

std::string SweepAxes::name(size_t number) const {
    assert(number < cases());
    const std::string& primitive = primitives[number % primitives.size()];
    number /= primitives.size();
    const std::string& ray = rays[number % rays.size()];
    number /= rays.size();
    return fmt::format("{} {} {} {}", models[number / resolutions.size()],
                       resolutions[number % resolutions.size()], ray, primitive);
}

uint64_t SweepAxes::hash(std::string_view more) const {
    Hash sum;
    const auto add = [&](std::string_view text) {
        sum.add_number(text.size()).add(text.data(), text.size());
    };
    for (const auto* axis : {&models, &resolutions, &rays, &primitives}) {
        sum.add_number(axis->size());
        for (const std::string& name : *axis) add(name);
    }
    add(more);
    return sum.value();
}

Shard parse_shard(std::string_view text) {
    const auto parts = split(text, '/');
    const auto index = parts.size() == 2 ? to_number(parts[0]) : std::nullopt;
    const auto count = parts.size() == 2 ? to_number(parts[1]) : std::nullopt;
    const auto whole = [](double number) { return number == std::floor(number); };
    if (!index || !count || !whole(*index) || !whole(*count) || !(*count >= 1 && *count <= 1e6) ||
        !(*index >= 1 && *index <= *count))
        fail(ExitCode::usage, "--shard {}: must be I/N with whole numbers, I from 1 to N", text);
    return {static_cast<uint32_t>(*index), static_cast<uint32_t>(*count)};
}

}  // namespace strandlab
