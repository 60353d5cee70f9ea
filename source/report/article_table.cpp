#include "report/article_table.h"

#include "report/fronts.h"
#include "report/row_fields.h"
#include "report/table.h"
#include "report/text_format.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace strandlab {
namespace {

using Json = nlohmann::ordered_json;

std::string number(std::optional<double> value, int digits, double factor = 1) {
    return value ? significant(*value * factor, digits) : "-";
}

std::string wrong_text(const Json& row) {
    const double share = row_error(row).wrong_share;
    return share >= 0 ? significant(100 * share, 2) : "-";
}

}  // namespace

std::string article_table(std::span<const Json> rows) {
    Table table({{"hair", "curves", true},
                 {"technique", "", true},
                 {"frame", "ms"},
                 {"+-", "%"},
                 {"buffers", "MB"},
                 {"leaves"},
                 {"structure", "MB"},
                 {"build", "ms"},
                 {"dt p99", "radii"},
                 {"wrong", "%"},
                 {"resolution", "", true}},
                2);
    for (const Json& row : rows) {
        if (text_at(row, "rays.name") != "primary" || is_second_opinion(row)) continue;
        const auto whole = [&](const char* path) {
            const auto value = number_at(row, path);
            return value ? grouped(static_cast<uint64_t>(*value)) : "-";
        };
        table.add_row(
            {whole("model.curves"), text_at(row, "primitive.label"),
             number(number_at(row, "time.trace_ms.median"), 4), number(number_at(row, "time.spread"), 2, 100),
             number(number_at(row, "memory.buffer_bytes"), 4, 1e-6), whole("memory.leaves"),
             number(number_at(row, "memory.kept_bytes"), 4, 1e-6), number(number_at(row, "time.build_ms"), 3),
             number(number_at(row, "model_error.all.distance.p99"), 2), wrong_text(row),
             text_at(row, "rays.resolution")});
    }
    return table.is_empty() ? "" : table.to_string(standard_output_style());
}

}  // namespace strandlab
