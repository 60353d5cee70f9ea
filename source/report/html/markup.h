// Text from result files inside HTML, SVG and scripts: never markup, whatever it says.
#pragma once

#include <string>
#include <string_view>

namespace strandlab {

/// The text as content or quoted attribute of HTML and SVG: & < > " ' are entities; control characters
/// and bytes that are not UTF-8 become U+FFFD.
std::string escape_markup(std::string_view text);

/// A scene's name with its parameters set apart: "bob,strands=9,points=3" is "bob <small>strands=9, points=3
/// </small>", without a line break.
std::string scene_markup(std::string_view scene);

/// JSON as the content of a <script> element: nothing in it can end the element or open a comment.
std::string escape_script(std::string_view json);

/// A coordinate with at most one digit after the point: "12", "0.5".
std::string coordinate(double value);

/// Bytes in base64 (RFC 4648).
std::string base64(std::string_view bytes);

/// "data:image/png;base64,...".
std::string data_uri(std::string_view media_type, std::string_view bytes);

}  // namespace strandlab
