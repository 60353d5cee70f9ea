// What tracing on a device leaves out where a scene does not need it. Each can be forced off, to see what it
// saves and that the answer stays the same.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

struct Skip {
    std::string_view name;
    std::string_view leaves_out;
    std::string_view where;
};

/// Names of those that a caller has to allow (trace/culling.h).
inline constexpr std::string_view reach_skip = "reach", detail_skip = "detail";

/// All of them, in the order in which reports list them.
std::span<const Skip> skips();

/// Error (usage) when a name is none of them: names the option and what there is.
void check_skips(std::span<const std::string> names);

}  // namespace strandlab
