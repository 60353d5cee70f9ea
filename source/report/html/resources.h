// Texts that were put into the program when it was built: the page's template, style and behaviour.
#pragma once

#include <string_view>

namespace strandlab {

/// The text of a file of source/report/html ("page.css"), or "d3.js", which is empty where the build found
/// no D3. Asserts that there is one of that name.
std::string_view resource(std::string_view name);

}  // namespace strandlab
