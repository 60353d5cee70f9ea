// Result files that grow row by row, so that an interrupted run keeps what it measured.
#pragma once

#include "report/result_row.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace strandlab {

/// Appends each row to a JSON Lines file and to a CSV file as soon as its case has ended. An empty path:
/// no such file. A new or empty CSV file gets its header first. A last line that an interrupted writer left
/// torn is cut off, with a warning.
class ResultWriter {
  public:
    /// resume: rows() are those that the JSON file holds already, and the CSV file is made again from them,
    /// since it may lack the last one. Throws Error (bad_input) when the CSV file has other columns or the
    /// JSON file holds something else.
    ResultWriter(std::string json_path, std::string csv_path, bool resume = false);

    const std::vector<nlohmann::ordered_json>& rows() const { return rows_; }

    /// The row as it was written. Throws Error (bad_input) when a file cannot be written.
    nlohmann::ordered_json add(const ResultRow& row) const;

  private:
    std::string json_path_, csv_path_;
    std::vector<nlohmann::ordered_json> rows_;
};

}  // namespace strandlab
