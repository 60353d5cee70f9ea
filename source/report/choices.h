// Which of some comparable rows to choose.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace strandlab {

/// Rows as numbers; nothing where no row is good enough.
struct Choices {
    std::optional<size_t> fastest, smallest;  // within the limit
    std::optional<size_t>
        most_accurate;  // the least RowError::ranking, then the fewest wrong rays, then time
    std::optional<size_t> fastest_of_all;  // whatever its error
    std::vector<size_t>
        as_fast;  // others within the limit whose 95 % interval of time meets that of the fastest
};

/// Chooses among members of one comparable_group: a row is within the limit (in radii) when its
/// RowError::ranking is. Measuring aids and Embree are never chosen.
Choices choose(std::span<const nlohmann::ordered_json> rows, std::span<const size_t> members, double limit);

}  // namespace strandlab
