// Fields of a result row by their path, whatever the row holds: rows come from files.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace strandlab {

/// The value at "time.trace_ms.median"; nullptr where a key is missing, null, or below something that is no
/// object.
const nlohmann::ordered_json* field_at(const nlohmann::ordered_json& row, std::string_view path);

/// The number there; nothing for anything else. "nan" and "inf" count as numbers.
std::optional<double> number_at(const nlohmann::ordered_json& row, std::string_view path);

/// The same with NaN for nothing.
double number_or_nan(const nlohmann::ordered_json& row, std::string_view path);

/// The text there; empty for anything else.
std::string text_at(const nlohmann::ordered_json& row, std::string_view path);

/// Whether true stands there.
bool is_true_at(const nlohmann::ordered_json& row, std::string_view path);

}  // namespace strandlab
