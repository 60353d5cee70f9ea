// Result rows as JSON objects, one a line (JSON Lines).
#pragma once

#include "report/result_row.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// A row as an object whose keys are always all there and in the same order. What was not measured is
/// null. JSON has no NaN and no infinity: they are the strings "nan", "inf" and "-inf". Hashes are strings
/// of 16 hexadecimal digits.
nlohmann::ordered_json to_json(const ResultRow& row);

/// Errors of a ray set as an object, as in a row.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// An object on one line, without the newline. Bytes that are not UTF-8 become U+FFFD.
std::string to_line(const nlohmann::ordered_json& object);

/// A number, or the string that stands for one that is not finite.
nlohmann::ordered_json json_number(double value);
/// Its inverse; nothing for null and whatever else is no number.
std::optional<double> number_of(const nlohmann::ordered_json& value);

/// Visits the objects of a JSON Lines file with the numbers of their lines (from 1). A last line that was cut
/// off (no newline, not an object) is left out with a warning: its writer was interrupted. Throws Error
/// (bad_input) naming file and line for any other line that is no JSON object.
void for_each_json_line(const std::string& path,
                        const std::function<void(size_t line, nlohmann::ordered_json& row)>& visit);

/// The same objects, all of them.
std::vector<nlohmann::ordered_json> read_json_lines(const std::string& path);

}  // namespace strandlab
