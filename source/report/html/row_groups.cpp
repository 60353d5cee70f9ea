#include "report/html/row_groups.h"

#include "primitives/primitive.h"
#include "report/fronts.h"
#include "report/row_fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string scene_name(const Json& row) {
    const std::string name = text_at(row, "model.name");
    const double instances = number_at(row, "model.instances").value_or(1);
    return instances > 1 ? fmt::format("{} × {:.0f}", name, instances) : name;
}

/// "640x360"; of schema 1, only pictures have one.
std::string resolution_of(const Json& row) {
    if (std::string text = text_at(row, "rays.resolution"); !text.empty()) return text;
    const double width = number_or_nan(row, "rays.width"), height = number_or_nan(row, "rays.height");
    return width > 0 && height > 0 ? fmt::format("{:.0f}x{:.0f}", width, height) : "";
}

/// Appends `tell_apart(row)` to a name where groups of other rows have the same names.
void tell_apart(std::vector<RowGroup>& groups, std::span<const Json> rows, std::string RowGroup::*name,
                std::string (*detail)(const Json&)) {
    std::map<std::string, std::vector<size_t>> same;
    for (size_t i = 0; i < groups.size(); ++i)
        same[groups[i].scene + '\n' + groups[i].rays + '\n' + groups[i].device + '\n' +
             groups[i].device_class]
            .push_back(i);
    for (const auto& entry : same) {
        const std::vector<size_t>& members = entry.second;
        const auto text = [&](size_t i) { return detail(rows[groups[i].members.front()]); };
        const bool differ = std::any_of(members.begin(), members.end(),
                                        [&](size_t i) { return text(i) != text(members[0]); });
        for (const size_t i : members)
            if (differ && !text(i).empty()) groups[i].*name += ", " + text(i);
    }
}

/// Embree ran on the processor of a machine: its rows belong to the devices of that machine.
bool is_of_the_same_machine(const Json& opinion, const Json& row) {
    return text_at(opinion, "context.cpu") == text_at(row, "context.cpu");
}

/// comparable_group without the device.
std::string same_work(Json row) {
    row["device"] = nullptr;
    return comparable_group(row);
}

/// Embree's rows go to the groups of the same work on the same machine, else to one of their own.
void add_opinions(std::vector<RowGroup>& groups, std::span<const Json> rows,
                  const std::vector<size_t>& opinions) {
    std::map<std::string, std::vector<size_t>> by_work;
    for (size_t i = 0; i < groups.size(); ++i)
        by_work[same_work(rows[groups[i].members.front()])].push_back(i);
    for (const size_t opinion : opinions)
        for (const size_t i : by_work[same_work(rows[opinion])])
            if (is_of_the_same_machine(rows[opinion], rows[groups[i].members.front()]))
                groups[i].opinions.push_back(opinion);
}

RowGroup named_group(const Json& row) {
    RowGroup group;
    group.scene = scene_name(row);
    group.rays = text_at(row, "rays.name") + " rays";
    group.device = short_device_name(text_at(row, "device.name"));
    group.device_class = text_at(row, "device.class");
    group.hit_or_miss_only = row_error(row).hit_or_miss_only;
    return group;
}

}  // namespace

std::string RowGroup::title() const {
    return fmt::format("{}, {}, {} ({} traversal)", scene, rays, device, device_class);
}

std::vector<size_t> RowGroup::all() const {
    std::vector<size_t> rows = members;
    rows.insert(rows.end(), opinions.begin(), opinions.end());
    return rows;
}

std::vector<RowGroup> row_groups(std::span<const Json> rows) {
    std::vector<RowGroup> groups;
    std::map<std::string, size_t> known;
    std::vector<size_t> opinions;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (is_second_opinion(rows[i])) {
            opinions.push_back(i);
            continue;
        }
        const auto [found, is_new] = known.emplace(comparable_group(rows[i]), groups.size());
        if (is_new) groups.push_back(named_group(rows[i]));
        groups[found->second].members.push_back(i);
    }
    add_opinions(groups, rows, opinions);
    tell_apart(groups, rows, &RowGroup::rays, resolution_of);
    tell_apart(groups, rows, &RowGroup::device,
               [](const Json& row) { return text_at(row, "device.driver"); });
    tell_apart(groups, rows, &RowGroup::scene,
               [](const Json& row) { return text_at(row, "model.hash").substr(0, 6); });
    tell_apart(groups, rows, &RowGroup::rays,
               [](const Json& row) { return text_at(row, "rays.hash").substr(0, 6); });
    return groups;
}

size_t series_of(const Json& row) {
    if (is_second_opinion(row)) return series_count - 1;
    const std::string name = text_at(row, "primitive.name");
    size_t place = 0;
    for (const Primitive& primitive : primitives()) {
        if (primitive.diagnostic) continue;
        if (primitive.name == name) return place % (series_count - 2);
        ++place;
    }
    return series_count - 2;  // measuring aids, and what this version does not know
}

std::string short_device_name(const std::string& name) { return name.substr(0, name.find(" (")); }

std::string row_label(const Json& row) {
    const std::string label = text_at(row, "primitive.label");
    if (!is_true_at(row, "primitive.caps_fell_back")) return label;
    return fmt::format("{} ({})", label, text_at(row, "primitive.caps"));
}

double draw_legend(Drawing& drawing, std::span<const Json> rows, std::span<const size_t> members, double x,
                   double y) {
    std::map<size_t, std::string> names;
    for (const size_t i : members) names.emplace(series_of(rows[i]), text_at(rows[i], "primitive.name"));
    double at = x;
    for (const auto& [series, name] : names) {
        const double width = 18 + text_width(shortened(name, 20), 11) + 12;
        if (at > x && at + width > drawing.width()) at = x, y += 16;
        drawing.mark("k", series, at + 6, y - 4);
        drawing.text("key", at + 16, y, shortened(name, 20));
        at += width;
    }
    return y + 16;
}

}  // namespace strandlab
