// The cases of one model at one resolution, as a run of bench goes through them.
#pragma once

#include "commands/bench_run.h"
#include "report/distant_pictures.h"

#include <algorithm>
#include <map>
#include <vector>

namespace strandlab {

/// The place of a choice among others; their number where it is none of them.
inline size_t index_of(const std::vector<PrimitiveChoice>& choices, const PrimitiveChoice& choice) {
    const auto found = std::find_if(choices.begin(), choices.end(), [&](const PrimitiveChoice& other) {
        return other.label() == choice.label();
    });
    return static_cast<size_t>(found - choices.begin());
}

/// A case that has no row yet.
struct BenchRun::Case {
    size_t set, primitive;
};

struct BenchRun::Block {
    size_t model, resolution;
    const Scene& scene;
    const Curves& curves;
    ModelFacts facts;
    RaySets rays;
    std::vector<RayFacts> ray_facts;  // of each set; of those not wanted empty
    CaseInput input;
    std::vector<Case> open;                              // cases to measure
    std::map<size_t, nlohmann::ordered_json> rows = {};  // by case number
    std::vector<ReferenceHit> picture_reference = {};    // of the rays that are a picture, once wanted
    std::map<size_t, std::vector<DistantError>> distances = {};  // of primitives, where wanted

    bool is_open(size_t set, size_t primitive) const {
        return std::any_of(open.begin(), open.end(),
                           [&](const Case& one) { return one.set == set && one.primitive == primitive; });
    }
};

}  // namespace strandlab
