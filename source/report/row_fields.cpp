#include "report/row_fields.h"

#include "report/result_json.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace strandlab {

using Json = nlohmann::ordered_json;

const Json* field_at(const Json& row, std::string_view path) {
    const Json* value = &row;
    while (true) {
        if (!value->is_object()) return nullptr;
        const size_t dot = path.find('.');
        const auto found = value->find(std::string(path.substr(0, dot)));
        if (found == value->end() || found->is_null()) return nullptr;
        value = &*found;
        if (dot == std::string_view::npos) return value;
        path.remove_prefix(dot + 1);
    }
}

std::optional<double> number_at(const Json& row, std::string_view path) {
    const Json* value = field_at(row, path);
    return value ? number_of(*value) : std::nullopt;
}

double number_or_nan(const Json& row, std::string_view path) {
    return number_at(row, path).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string text_at(const Json& row, std::string_view path) {
    const Json* value = field_at(row, path);
    return value && value->is_string() ? value->get<std::string>() : "";
}

bool is_true_at(const Json& row, std::string_view path) {
    const Json* value = field_at(row, path);
    return value && value->is_boolean() && value->get<bool>();
}

}  // namespace strandlab
