// Result files that grow row by row, so that an interrupted run keeps what it measured.
#pragma once

#include "report/result_row.h"

#include <string>

namespace strandlab {

/// Appends each row to a JSON Lines file and to a CSV file as soon as its case has ended. An empty path:
/// no such file. A new or empty CSV file gets its header first.
class ResultWriter {
  public:
    /// Throws Error (bad_input) when the CSV file already has other columns.
    ResultWriter(std::string json_path, std::string csv_path);

    /// Throws Error (bad_input) when a file cannot be written.
    void add(const ResultRow& row) const;

  private:
    std::string json_path_, csv_path_;
};

}  // namespace strandlab
