#include "report/text_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace strandlab {

std::string significant(double value, int digits) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    if (value == 0) return "0";
    // The exponent after rounding: 9.996 has one more digit before the point than 9.99.
    const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
    const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
    if (exponent < -3 || exponent >= 6) return scientific;
    return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent));
}

std::string grouped(uint64_t count) {
    std::string text = std::to_string(count);
    for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3)
        text.insert(text.begin() + i, ',');
    return text;
}

std::string bytes_text(uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    constexpr std::array<std::string_view, 5> units{"kB", "MB", "GB", "TB", "PB"};
    double value = static_cast<double>(bytes) / 1000;
    size_t unit = 0;
    // 999.5 would be written as "1000".
    for (; value >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000;
    return fmt::format("{} {}", significant(value), units[unit]);
}

std::string percent(double share) { return significant(share * 100, share >= 0.995 ? 3 : 2) + " %"; }

}  // namespace strandlab
