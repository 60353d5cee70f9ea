// Result files of many machines and shards as one set of rows.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// All rows of some result files, each once.
struct MergedResults {
    std::vector<nlohmann::ordered_json>
        rows;  // of bench; "folder" is that of the row's file, for its pictures
    std::vector<nlohmann::ordered_json> stress;  // cells of stress runs
    std::vector<std::string> missing;            // cases of the rows' sweeps without a row
    std::vector<std::string> silent_shards;      // "shard 2 of 4 of sweep ID": those without any row
    size_t replaced = 0;                         // rows that a later one with the same key took the place of
};

/// Reads the files (JSON Lines of bench and of stress, in any mix). Of rows with the same key the last one
/// counts. What a report does not show (samples, rays that start inside or hit caps) is dropped, so that
/// ten thousand rows take little memory. Throws Error (bad_input) naming file and line for what is neither.
MergedResults merge_result_files(std::span<const std::string> paths);

}  // namespace strandlab
