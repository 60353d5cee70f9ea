// Result rows for tests of tables and reports.
#pragma once

#include "report/result_json.h"
#include "report/result_row.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace strandlab::testing_tools {

/// A measured row: time in ms, bytes per curve, the 99th percentile of |dt|/r, and wrong rays of a thousand.
inline ResultRow result_row(const std::string& primitive, double ms, double bytes, double p99,
                            uint64_t wrong = 0) {
    ResultRow row;
    row.model = facts_of("tuft", Curves{});
    row.model.curves = 100;
    row.rays.name = "primary";
    row.rays.count = 1000;
    row.rays.width = 40;
    row.rays.height = 25;
    row.rays.samples = 1;
    row.primitive = facts_of(parse_primitive(primitive), Caps::round);
    row.device.name = "llvmpipe (LLVM 15)";
    row.device.driver = "llvmpipe";
    row.device.kind = "cpu";
    row.trace_ms = {ms * 0.98, ms, ms * 1.03};
    row.cost.emplace();
    row.cost->builds.kept_bytes = static_cast<uint64_t>(70 * bytes);
    row.cost->record_bytes = static_cast<uint64_t>(30 * bytes);
    row.cost->builds.input_bytes = static_cast<uint64_t>(20 * bytes);
    Comparison error;
    for (Tally* tally : {&error.all, &error.decisive}) {
        tally->rays = 1000;
        tally->false_miss = {wrong, 500};
        tally->false_hit.trials = 500;
        tally->matches = 500 - wrong;
        tally->measures[0] = {500, p99 / 8, p99 / 2, p99, p99 * 2, p99 * 3, 0};
    }
    row.model_error = error;
    for (auto& measure : error.decisive.measures)
        measure.p50 /= 1000, measure.p99 /= 1000, measure.max /= 1000;
    row.intersector_error = error;
    row.seed = 1;
    row.context.cpu = "processor";
    row.context.commit = "0123456789";
    row.context.time = "2025-01-31T12:00:00Z";
    return row;
}

}  // namespace strandlab::testing_tools
