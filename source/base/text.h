// Small text helpers for messages and option parsing.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// The candidate with the smallest edit distance to word, when it is near enough to be meant.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);

/// "a, b or c".
std::string list_of(std::span<const std::string> words, std::string_view last = "or");

/// Pieces between separators; an empty text gives none.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The whole text as a number; nothing when any character is left over.
std::optional<double> to_number(std::string_view text);

/// The text with '?' for every control character: one line, and nothing that moves a terminal's cursor,
/// whatever a file or an option put into it.
std::string one_line(std::string_view text);

}  // namespace strandlab
