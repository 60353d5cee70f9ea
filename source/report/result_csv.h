// Result rows as comma-separated values: the view for spreadsheets and plotting programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// A field as RFC 4180 wants it: in quotes, with quotes doubled, where it holds a comma, quote or line
/// break or begins or ends with a space.
std::string csv_field(std::string_view text);

/// Fields joined by commas, without the line break.
std::string csv_line(std::span<const std::string> fields);

/// Names of the columns: the keys of a row's JSON object, joined by points ("time.trace_ms.median"). Of
/// rays outside the decisive group only counts are in it, and no single ray; JSON has them.
const std::vector<std::string>& csv_columns();

/// The fields of a row made by to_json, one for each column: empty for null; samples, and figures
/// at growing distances, separated by ';', parameters as "key=value,key=value".
std::vector<std::string> csv_fields(const nlohmann::ordered_json& row);

}  // namespace strandlab
