#include "report/result_writer.h"

#include "base/error.h"
#include "base/file.h"
#include "report/result_csv.h"
#include "report/result_json.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <utility>

namespace strandlab {
namespace {

std::string first_line(const std::string& path) {
    std::string line;
    std::getline(std::ifstream(path, std::ios::binary), line);
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

}  // namespace

ResultWriter::ResultWriter(std::string json_path, std::string csv_path)
    : json_path_(std::move(json_path)), csv_path_(std::move(csv_path)) {
    for (const std::string& path : {json_path_, csv_path_})
        if (!path.empty()) check_appendable(path);
    if (csv_path_.empty()) return;
    const std::string header = first_line(csv_path_);
    if (!header.empty() && header != csv_line(csv_columns()))
        fail(ExitCode::bad_input, "{}: its columns are not those of this version; choose another file",
             csv_path_);
}

void ResultWriter::add(const ResultRow& row) const {
    const nlohmann::ordered_json object = to_json(row);
    if (!json_path_.empty()) append_line(json_path_, to_line(object));
    if (csv_path_.empty()) return;
    if (first_line(csv_path_).empty()) append_line(csv_path_, csv_line(csv_columns()));
    append_line(csv_path_, csv_line(csv_fields(object)));
}

}  // namespace strandlab
