#include "report/result_writer.h"

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "report/result_csv.h"
#include "report/result_json.h"

#include <filesystem>
#include <fstream>
#include <utility>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string first_line(const std::string& path) {
    std::string line;
    std::getline(std::ifstream(path, std::ios::binary), line);
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

void check_columns(const std::string& path) {
    const std::string header = first_line(path), columns = csv_line(csv_columns());
    std::error_code error;
    const bool is_torn =
        columns.starts_with(header) && std::filesystem::file_size(path, error) == header.size();
    if (!header.empty() && header != columns && !is_torn)
        fail(ExitCode::bad_input, "{}: its columns are not those of this version; choose another file", path);
}

void write_csv(const std::string& path, const std::vector<Json>& rows) {
    std::string text = csv_line(csv_columns()) + "\n";
    for (const Json& row : rows) text += csv_line(csv_fields(row)) + "\n";
    write_file(path, text);
}

}  // namespace

ResultWriter::ResultWriter(std::string json_path, std::string csv_path, bool resume)
    : json_path_(std::move(json_path)), csv_path_(std::move(csv_path)) {
    for (const std::string& path : {json_path_, csv_path_})
        if (!path.empty()) check_appendable(path);
    const auto repair = [](const std::string& path, auto&& is_whole) {
        if (!path.empty() && std::filesystem::is_regular_file(path) && drop_torn_line(path, is_whole))
            warn("{}: its last line was torn by an interrupted run and is cut off", path);
    };
    if (!csv_path_.empty()) check_columns(csv_path_);
    repair(json_path_, [](std::string_view line) { return Json::accept(line); });
    repair(csv_path_, [](std::string_view) { return false; });
    if (!resume) return;
    if (std::filesystem::is_regular_file(json_path_)) rows_ = read_json_lines(json_path_);
    if (!csv_path_.empty()) write_csv(csv_path_, rows_);
}

Json ResultWriter::add(const ResultRow& row) const {
    Json object = to_json(row);
    if (!json_path_.empty()) append_line(json_path_, to_line(object));
    if (csv_path_.empty()) return object;
    append_line(csv_path_, csv_line(csv_fields(object)), csv_line(csv_columns()));
    return object;
}

}  // namespace strandlab
