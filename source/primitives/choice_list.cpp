#include "primitives/choice_list.h"

#include "base/error.h"
#include "base/text.h"

#include <cmath>

namespace strandlab {
namespace {

/// One key with all its values.
struct Axis {
    std::string key;  // with its '='
    std::vector<std::string> values;
};

constexpr double longest_range = 1000;

/// The whole numbers of "a..b"; anything else is one value.
void add_values(std::string_view specification, std::string_view text, std::vector<std::string>& values) {
    const size_t dots = text.find("..");
    const auto low = dots == std::string_view::npos ? std::nullopt : to_number(text.substr(0, dots));
    const auto high = dots == std::string_view::npos ? std::nullopt : to_number(text.substr(dots + 2));
    if (!low || !high || *low != std::floor(*low) || *high != std::floor(*high)) {
        values.emplace_back(text);
        return;
    }
    if (!(*low <= *high && *high - *low < longest_range))
        fail(ExitCode::usage, "--primitive {}: the range {} has no numbers, or more than {:g}", specification,
             text, longest_range);
    for (double number = *low; number <= *high; ++number) values.push_back(fmt::format("{:.0f}", number));
}

}  // namespace

std::vector<std::string> expand_lists(std::string_view specification) {
    const size_t colon = specification.find(':');
    if (colon == std::string_view::npos) return {std::string(specification)};
    std::vector<Axis> axes;
    for (const std::string_view part : split(specification.substr(colon + 1), ',')) {
        const size_t equals = part.find('=');
        if (equals != std::string_view::npos)
            axes.push_back({std::string(part.substr(0, equals + 1)), {}});
        else if (axes.empty())
            return {std::string(specification)};  // not key=value: whoever parses it says so
        add_values(specification, equals == std::string_view::npos ? part : part.substr(equals + 1),
                   axes.back().values);
    }
    std::vector<std::string> all{std::string(specification.substr(0, colon))};
    for (const Axis& axis : axes) {
        std::vector<std::string> longer;
        for (const std::string& begin : all)
            for (const std::string& value : axis.values)
                longer.push_back(begin + (&axis == &axes.front() ? ":" : ",") + axis.key + value);
        if (double(longer.size()) > longest_range)
            fail(ExitCode::usage, "--primitive {}: more than {:g} combinations", specification,
                 longest_range);
        all = std::move(longer);
    }
    return all;
}

std::vector<PrimitiveChoice> parse_primitives(std::string_view text, std::string_view caps) {
    std::vector<PrimitiveChoice> choices;
    for (const std::string& one : expand_lists(text)) choices.push_back(parse_primitive(one, caps));
    return choices;
}

}  // namespace strandlab
