// Result rows (JSON Lines) and cache entries.
#include "base/cache.h"
#include "fuzz/file_targets.h"
#include "fuzz/input_reader.h"
#include "fuzz/refusal.h"
#include "fuzz/samples.h"
#include "fuzz/scratch_folder.h"
#include "report/result_csv.h"
#include "report/result_json.h"

#include <nlohmann/json.hpp>

namespace strandlab::fuzz {
namespace {

void run_rows(Bytes input) {
    const std::string path = scratch_folder().write("rows.jsonl", input);
    std::vector<nlohmann::ordered_json> rows;
    if (!accepts([&] { rows = read_json_lines(path); })) return;
    for (const nlohmann::ordered_json& row : rows) {
        require(row.is_object(), "a row that is no object");
        require(to_line(row).find('\n') == std::string::npos, "a row of two lines");
        require(csv_fields(row).size() == csv_columns().size(), "a field too many or too few");
        for (const auto& [key, value] : row.items()) number_of(value);
    }
}

std::vector<std::string> row_seeds() {
    ResultRow row;
    row.trace_ms = {1.5, 2.0};
    row.cost.emplace();
    row.model_error.emplace();
    return {to_line(to_json(row)) + "\n", "{\"a\": \"nan\", \"b\": [1, null]}\n{}\n{\"cut\": "};
}

constexpr std::string_view key = "oracle/1 surface=0 rays=0";

/// The input is the file of an entry; a payload counts only if writing it gives that file again.
void run_cache(Bytes input) {
    const Cache cache(scratch_folder().path() / "cache");
    static const bool made = std::filesystem::create_directories(scratch_folder().path() / "cache");
    require(made || std::filesystem::exists(scratch_folder().path() / "cache"), "no folder for the cache");
    const std::string entry = "cache/" + cache.file_of(key).filename().string();
    scratch_folder().write(entry, input);
    const auto payload = cache.read(key);
    if (!payload) return require(!cache.read(key), "a damaged entry came back");
    cache.write(key, *payload);
    const auto again = cache.read(key);
    require(again && *again == *payload, "an entry does not come back");
}

std::vector<std::string> cache_seeds() {
    const Cache cache(scratch_folder().path() / "seeds");
    std::vector<std::string> all;
    for (const std::string& payload : {std::string("some bytes"), std::string()}) {
        cache.write(key, samples::as_bytes(payload));
        std::string bytes(std::filesystem::file_size(cache.file_of(key)), '\0');
        std::FILE* const file = std::fopen(cache.file_of(key).c_str(), "rb");
        require(file && std::fread(bytes.data(), 1, bytes.size(), file) == bytes.size(), "no entry");
        std::fclose(file);
        all.push_back(bytes);
    }
    return all;
}

}  // namespace

FuzzTarget rows_target() { return {"rows", run_rows, row_seeds}; }
FuzzTarget cache_target() { return {"cache", run_cache, cache_seeds}; }

}  // namespace strandlab::fuzz
