// Stress tallies of one primitive over the first pairs of a family.
#pragma once

#include "measure/stress_limits.h"

#include <string>

namespace strandlab::testing_tools {

inline StressTally tally_of(const std::string& label, const StressFamily& family, Precision precision,
                            uint64_t count) {
    const PrimitiveChoice choice = parse_primitive(label);
    const StressRange range{&family, default_stress_seed, 0, count};
    const Curves strands = stress_strands(range);
    const StressPairs pairs = stress_pairs(range, choice.primitive->surface(strands, choice.options));
    const Geometry geometry = choice.primitive->build(strands, choice.options);
    StressTally tally;
    const auto hits = intersect_pairs(*choice.primitive, geometry, pairs, precision, tally.boxes);
    add_errors(pairs, hits, 3, tally);
    return tally;
}

inline StressVerdict verdict_of(const std::string& label, const StressFamily& family, Precision precision,
                                const StressTally& tally) {
    const bool precise = precision == Precision::precise;
    const std::string primitive = parse_primitive(label).primitive->name;
    return judge(tally, stress_limits(primitive, family, precise), family, precise).verdict;
}

}  // namespace strandlab::testing_tools
