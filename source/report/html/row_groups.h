// Rows of a report that may be compared with each other, and how a page names them.
#pragma once

#include "report/html/drawing.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// Rows of one model, one ray set and one device. The two kinds of traversal never meet in a group.
struct RowGroup {
    std::string scene, rays, device, device_class;  // as people read them: "primary rays"
    bool hit_or_miss_only = false;
    std::vector<size_t> members;
    std::vector<size_t> opinions;  // Embree's rows of the same rays on the same machine's processor

    /// "curly, primary rays, llvmpipe (software traversal)".
    std::string title() const;
    /// Members, then opinions.
    std::vector<size_t> all() const;
};

/// The groups in the order in which their first rows come. Where two of a page would have one name, their
/// resolution or a part of their hash tells them apart.
std::vector<RowGroup> row_groups(std::span<const nlohmann::ordered_json> rows);

/// The number of the shape and colour of a row's primitive: that of its place in the registry, the last one
/// for Embree.
size_t series_of(const nlohmann::ordered_json& row);

/// A device's name without what follows in brackets.
std::string short_device_name(const std::string& name);

/// "lss:segments=8", with the caps where they are not those of the scene: "dots (open)".
std::string row_label(const nlohmann::ordered_json& row);

/// One line per series that is present, from (x, y) on to the right, wrapped at the drawing's edge; returns
/// where the next line would be.
double draw_legend(Drawing& drawing, std::span<const nlohmann::ordered_json> rows,
                   std::span<const size_t> members, double x, double y);

}  // namespace strandlab
