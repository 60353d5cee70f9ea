// Long texts of a page in little space.
#pragma once

#include <string>
#include <string_view>

namespace strandlab {

/// Texts longer than this are packed: a page of ten thousand rows then takes two megabytes instead of eleven.
inline constexpr size_t longest_plain_text = 256 * 1024;

/// The text as zlib data (RFC 1950, "deflate" of browsers' DecompressionStream) in base64.
std::string packed(std::string_view text);

/// A <script> element with data that page.js reads by its id; packed where it is long.
std::string data_element(const std::string& id, std::string_view json);

/// Markup as it is, or, where it is long, as a packed element that page.js puts the markup in the place of.
std::string markup_or_packed(std::string_view markup);

}  // namespace strandlab
