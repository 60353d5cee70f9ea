#include "base/parameters.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace strandlab {

Parameters::Parameters(const std::vector<ParameterInfo>& table) {
    for (const ParameterInfo& info : table) values_[info.name] = info.default_value;
}

void Parameters::set(std::string_view context, const std::vector<ParameterInfo>& table, std::string_view key,
                     std::string_view value) {
    const auto info = std::find_if(table.begin(), table.end(), [&](const auto& p) { return p.name == key; });
    if (info == table.end()) {
        std::vector<std::string> names;
        for (const ParameterInfo& p : table) names.push_back(p.name);
        const auto guess = nearest(key, names);
        fail(ExitCode::usage, "{}: no parameter '{}'{}; it has {}", context, key,
             guess ? fmt::format(", did you mean '{}'?", *guess) : "",
             names.empty() ? "none" : list_of(names, "and"));
    }
    if (!info->choices.empty()) {
        if (std::find(info->choices.begin(), info->choices.end(), value) == info->choices.end())
            fail(ExitCode::usage, "{}: {}={} is not {}", context, key, value, list_of(info->choices));
    } else {
        const auto number = to_number(value);
        if (!number || !(*number >= info->low && *number <= info->high) ||
            (info->integer && *number != std::floor(*number)))
            fail(ExitCode::usage, "{}: {}={} is not a {}number from {:g} to {:g}", context, key, value,
                 info->integer ? "whole " : "", info->low, info->high);
    }
    values_[info->name] = std::string(value);
}

void Parameters::set_all(std::string_view context, const std::vector<ParameterInfo>& table,
                         std::string_view text) {
    for (const std::string_view pair : split(text, ',')) {
        const size_t equals = pair.find('=');
        if (equals == std::string_view::npos)
            fail(ExitCode::usage, "{}: '{}' is not key=value", context, pair);
        set(context, table, pair.substr(0, equals), pair.substr(equals + 1));
    }
}

double Parameters::number(const std::string& name) const { return to_number(values_.at(name)).value(); }

std::string Parameters::to_string(const std::vector<ParameterInfo>& table, bool all) const {
    std::string text;
    for (const ParameterInfo& info : table) {
        const std::string& value = values_.at(info.name);
        if (!all && value == info.default_value) continue;
        text += (text.empty() ? "" : ",") + info.name + "=" + value;
    }
    return text;
}

}  // namespace strandlab
