#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/result_json.h"
#include "report/row_fields.h"
#include "report/text_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <vector>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

struct Fact {
    const char* heading;
    const char* path;
};

std::string fact_text(const Json& row, const Fact& fact) {
    const Json* value = field_at(row, fact.path);
    if (!value) return "";
    if (value->is_string()) return value->get<std::string>();
    if (std::string_view(fact.path).ends_with("_bytes") && value->is_number_unsigned())
        return bytes_text(value->get<uint64_t>());
    return value->is_number_unsigned() ? grouped(value->get<uint64_t>()) : to_line(*value);
}

/// A table of all different combinations of some facts, with the number of rows of each.
std::string facts_table(const PageData& data, const char* title, const std::vector<Fact>& facts) {
    std::vector<std::vector<std::string>> order;
    std::map<std::vector<std::string>, size_t> counts;
    for (const Json& row : data.results.rows) {
        std::vector<std::string> texts;
        for (const Fact& fact : facts) texts.push_back(fact_text(row, fact));
        if (counts[texts]++ == 0) order.push_back(std::move(texts));
    }
    std::vector<bool> is_known(facts.size(), false);
    for (const auto& texts : order)
        for (size_t i = 0; i < facts.size(); ++i) is_known[i] = is_known[i] || !texts[i].empty();
    std::string html = fmt::format(
        "<details open><summary>{} <small>{}</small></summary><div class=\"scroll\"><table "
        "class=\"facts\"><thead><tr>",
        title, order.size());
    for (size_t i = 0; i < facts.size(); ++i)
        if (is_known[i]) html += fmt::format("<th>{}</th>", facts[i].heading);
    html += "<th>rows</th></tr></thead><tbody>\n";
    for (const auto& texts : order) {
        html += "<tr>";
        for (size_t i = 0; i < facts.size(); ++i)
            if (is_known[i]) html += fmt::format("<td>{}</td>", escape_markup(texts[i]));
        html += fmt::format("<td class=\"n\">{}</td></tr>\n", grouped(counts[texts]));
    }
    return html + "</tbody></table></div></details>\n";
}

}  // namespace

std::string context_section(const PageData& data) {
    if (data.results.rows.empty()) return "";
    return facts_table(data, "Programs",
                       {{"version", "context.version"},
                        {"commit", "context.commit"},
                        {"modified", "context.modified"},
                        {"compiler", "context.compiler"},
                        {"flags", "context.flags"},
                        {"build", "context.build_type"},
                        {"shaders", "context.shaders"}}) +
           facts_table(data, "Machines",
                       {{"processor", "context.cpu"},
                        {"cores", "context.cores"},
                        {"threads", "context.threads"},
                        {"memory", "context.memory_bytes"},
                        {"system", "context.system"}}) +
           facts_table(data, "Devices",
                       {{"device", "device.name"},
                        {"driver", "device.driver"},
                        {"API", "device.api_version"},
                        {"kind", "device.kind"},
                        {"traversal", "device.class"},
                        {"memory", "device.memory_bytes"},
                        {"validation layers", "device.validation_layers"}}) +
           facts_table(data, "Models",
                       {{"model", "model.name"},
                        {"given as", "model.spec"},
                        {"hash", "model.hash"},
                        {"strands", "model.strands"},
                        {"curves", "model.curves"},
                        {"instances", "model.instances"}}) +
           facts_table(data, "Ray sets",
                       {{"model", "model.name"},
                        {"rays", "rays.name"},
                        {"kind", "rays.kind"},
                        {"number", "rays.count"},
                        {"resolution", "rays.resolution"},
                        {"samples", "rays.samples"},
                        {"shuffled", "rays.shuffled"},
                        {"as shadow rays", "rays.as_shadow"},
                        {"seed", "rays.seed"},
                        {"camera", "rays.camera"},
                        {"hash", "rays.hash"}}) +
           facts_table(data, "Settings",
                       {{"samples", "settings.repeat"},
                        {"warm-up, ms", "settings.warm_up_ms"},
                        {"error rays", "settings.error_rays"},
                        {"leaf order", "settings.leaf_order"},
                        {"compaction", "settings.compaction"},
                        {"normals", "settings.normals"},
                        {"strand ends", "settings.caps"},
                        {"strands left out by", "settings.cull"},
                        {"strands left out", "settings.left_out_strands"},
                        {"seed", "seed"},
                        {"schema", "schema"}});
}

}  // namespace strandlab
