#include "report/profile_table.h"

#include "report/row_fields.h"
#include "report/table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace strandlab {

using Json = nlohmann::ordered_json;

namespace {

std::string number(const Json& row, const char* path, double scale = 1) {
    const auto value = number_at(row, path);
    return value ? fmt::format("{:.3g}", scale * *value) : "-";
}

std::string ratio(const Json& row, const char* path) {
    const auto part = number_at(row, path), whole = number_at(row, "profile.trace_ms");
    return part && whole ? fmt::format("{:.2f}", *part / *whole) : "-";
}

std::string hit_share(const Json& row) {
    const auto hits = number_at(row, "profile.hits"), rays = number_at(row, "rays.count");
    return hits && rays && *rays > 0 ? fmt::format("{:.3g}", 100 * *hits / *rays) : "-";
}

std::string shader_lines(const Json& row) {
    const Json* shaders = field_at(row, "profile.shaders");
    std::string text, last;
    if (shaders == nullptr || !shaders->is_array()) return text;
    for (const Json& one : *shaders) {
        const std::string shader = text_at(one, "shader");
        text += shader == last && !text.empty() ? ", "
                                                : fmt::format("{}  {}: ", text.empty() ? "" : "\n", shader);
        text += text_at(one, "name") + " " + text_at(one, "value");
        last = shader;
    }
    if (!text.empty()) text = fmt::format("{}, shaders\n{}\n", text_at(row, "primitive.label"), text);
    return text;
}

constexpr const char* legend =
    R"(leaves: intersector invocations a ray; at hit: of rays cut at their hit, the fewest that any order of finding it can
make. false: leaves entered without a hit there that is nearer. searched: leaves that no early test turned away.
iterations: of searches (cones or capsules tried, steps of refinement) a ray. floor: an intersector that always misses, on
whole rays and on rays cut at their hit, relative to the trace: what of it is traversal. Counted by instrumented shaders in
a trace of its own. Triangles on a device: the driver's own test tells nothing.
)";

}  // namespace

std::string profile_table(std::span<const Json> rows) {
    Table table({{"model", "", true},
                 {"rays", "", true},
                 {"primitive", "", true},
                 {"hit", "%"},
                 {"leaves", "/ray"},
                 {"at hit", "/ray"},
                 {"most", "leaves"},
                 {"false", "%"},
                 {"searched", "%"},
                 {"iterations", "/ray"},
                 {"most", "iterations"},
                 {"reports", "/ray"},
                 {"trace", "ms"},
                 {"floor", "of trace"},
                 {"at hit", "of trace"}},
                3);
    std::string shaders;
    for (const Json& row : rows) {
        if (field_at(row, "profile") == nullptr) continue;
        table.add_row(
            {text_at(row, "model.name"), text_at(row, "rays.name"), text_at(row, "primitive.label"),
             hit_share(row), number(row, "profile.work.leaves_per_ray"),
             number(row, "profile.work_at_hit.leaves_per_ray"), number(row, "profile.work.most_leaves"),
             number(row, "profile.work.false_entry_share", 100),
             number(row, "profile.work.searched_share", 100), number(row, "profile.work.iterations_per_ray"),
             number(row, "profile.work.most_iterations"), number(row, "profile.work.reports_per_ray"),
             number(row, "profile.trace_ms"), ratio(row, "profile.floor_ms"),
             ratio(row, "profile.floor_at_hit_ms")});
        shaders += shader_lines(row);
    }
    if (table.is_empty()) return "";
    return fmt::format("profile\n{}{}{}", table.to_string(standard_output_style()), shaders, legend);
}

}  // namespace strandlab
