// The cases of a sweep: every combination of its axes, numbered, and split among machines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// The axes of a sweep by their names in results. Case ((model R + resolution) S + ray set) P + primitive,
/// for R resolutions, S ray sets and P primitives.
struct SweepAxes {
    std::vector<std::string> models, resolutions, rays, primitives;

    size_t cases() const { return models.size() * resolutions.size() * rays.size() * primitives.size(); }
    size_t number(size_t model, size_t resolution, size_t ray, size_t primitive) const {
        return ((model * resolutions.size() + resolution) * rays.size() + ray) * primitives.size() +
               primitive;
    }
    /// "curly 640x360 primary lss": a case by its number.
    std::string name(size_t number) const;
    /// Of all names, and of a text that says what else makes a sweep.
    uint64_t hash(std::string_view more = {}) const;
};

/// One of several parts of a sweep, for one machine.
struct Shard {
    uint32_t index = 1, count = 1;  // index from 1

    /// Parts are runs of consecutive cases whose lengths differ by at most one.
    bool holds(size_t number, size_t cases) const { return number * count / cases == index - 1; }
};

/// Parses "2/4". Throws Error (usage) naming --shard, the value and what is allowed.
Shard parse_shard(std::string_view text);

/// Which case of which sweep a row is.
struct SweepFacts {
    std::shared_ptr<const SweepAxes> axes;  // none: the row is of no sweep
    uint64_t id = 0;                        // the hash of the axes: the same for all shards and resumed runs
    size_t number = 0;
    Shard shard;
};

}  // namespace strandlab
