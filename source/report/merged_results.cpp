#include "report/merged_results.h"

#include "base/error.h"
#include "report/merge.h"
#include "report/result_json.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

/// More than a file may claim: each is named.
constexpr double most_shards = 100'000;

void erase(Json& object, const char* key) {
    if (object.is_object()) object.erase(key);
}

/// Drops what no report shows, which is most of a row.
void prune(Json& row) {
    for (const char* key : {"samples_ms", "wall_samples_ms", "positions"})
        if (row.contains("time")) erase(row["time"], key);
    if (field_at(row, "time.ratio")) erase(row["time"]["ratio"], "samples");
    for (const auto& [error, group] : {std::pair("intersector_error", "decisive"), {"model_error", "all"}}) {
        if (!row.contains(error) || !row[error].is_object()) continue;
        for (const char* other : {"decisive", "all", "on_cap", "inside", "inside_own"})
            if (std::string_view(other) != group) erase(row[error], other);
        if (!row[error].contains(group) || !row[error][group].is_object()) continue;
        for (auto& [name, value] : row[error][group].items())
            for (const char* key :
                 {"first_ray", "worst_ray", name == "distance" ? "" : "decades", "low", "high"})
                erase(value, key);
    }
}

bool is_stress_cell(const Json& row) { return row.contains("family") && row.contains("verdict"); }
bool is_bench_row(const Json& row) { return row.contains("key") && row.contains("primitive"); }

std::vector<std::string> silent_shards(std::span<const Json> rows) {
    std::map<std::string, std::pair<size_t, std::set<size_t>>> sweeps;  // shards that there are, those seen
    for (const Json& row : rows) {
        const auto shard = number_at(row, "sweep.shard"), shards = number_at(row, "sweep.shards");
        if (!shard || !shards || !(*shard >= 1 && *shard <= *shards && *shards <= most_shards)) continue;
        auto& [count, seen] = sweeps[text_at(row, "sweep.id")];
        count = std::max(count, static_cast<size_t>(*shards));
        seen.insert(static_cast<size_t>(*shard));
    }
    std::vector<std::string> silent;
    for (const auto& [id, sweep] : sweeps)
        for (size_t i = 1; i <= sweep.first; ++i)
            if (!sweep.second.contains(i))
                silent.push_back(fmt::format("shard {} of {} of sweep {}", i, sweep.first, id));
    return silent;
}

}  // namespace

MergedResults merge_result_files(std::span<const std::string> paths) {
    MergedResults merged;
    std::vector<Json> rows;
    for (const std::string& path : paths) {
        const std::string folder = std::filesystem::path(path).parent_path().string();
        for_each_json_line(path, [&](size_t line, Json& row) {
            if (is_stress_cell(row)) {
                merged.stress.push_back(std::move(row));
                return;
            }
            if (!is_bench_row(row))
                fail(ExitCode::bad_input, "{}: line {} is a row of neither bench nor stress", path, line);
            prune(row);
            row["folder"] = folder;
            rows.push_back(std::move(row));
        });
    }
    const size_t read = rows.size();
    merged.rows = merged_rows(std::move(rows));
    merged.replaced = read - merged.rows.size();
    merged.missing = missing_cases(merged.rows);
    if (!merged.missing.empty()) merged.silent_shards = silent_shards(merged.rows);
    return merged;
}

}  // namespace strandlab
