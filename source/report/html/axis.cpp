#include "report/html/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace strandlab {
namespace {

/// Powers of ten are exact where floating point can be, so that labels are what they say.
double power_of_ten(int exponent) { return std::stod(fmt::format("1e{}", exponent)); }

/// The greatest of 1, 2 or 5 times a power of ten that is at most value.
double round_down(double value) {
    const double decade = power_of_ten(static_cast<int>(std::floor(std::log10(value))));
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * decade <= value) return factor * decade;
    return decade / 2;  // the logarithm was rounded up
}

/// The least of 1, 2 or 5 times a power of ten that is at least value.
double round_up(double value) {
    const double decade = power_of_ten(static_cast<int>(std::floor(std::log10(value))));
    for (const double factor : {1.0, 2.0, 5.0, 10.0})
        if (factor * decade >= value) return factor * decade;
    return 20 * decade;
}

std::string superscript(int number) {
    constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(number)) text += c == '-' ? "⁻" : digits[static_cast<size_t>(c - '0')];
    return text;
}

}  // namespace

std::string tick_label(double value) {
    if (value == 0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
    if (exponent >= -3 && exponent <= 3) return fmt::format("{:.4g}", value);
    const double mantissa = value / power_of_ten(exponent);
    const std::string power = "10" + superscript(exponent);
    return std::abs(mantissa - 1) < 1e-9 ? power : fmt::format("{:.3g}×{}", mantissa, power);
}

LogAxis::LogAxis(std::span<const double> values, double from, double to) : from_(from), to_(to) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const double value : values)
        // Beyond, round figures around the values would not be numbers.
        if (value > 1e-300 && value < 1e300) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    if (most == 0) least = 1, most = 10;
    low_ = round_down(least);
    high_ = round_up(most);
    while (high_ < 9.99 * low_) {
        low_ = round_down(low_ * 0.99);
        if (high_ < 9.99 * low_) high_ = round_up(high_ * 1.01);
    }
}

LogAxis LogAxis::doubling(double low, double high, double from, double to) {
    LogAxis axis({}, from, to);
    axis.low_ = low;
    axis.high_ = high;
    axis.doubling_ = true;
    return axis;
}

double LogAxis::at(double value) const {
    const double low = std::log(low_);
    return from_ + (to_ - from_) * (std::log(value) - low) / (std::log(high_) - low);
}

std::vector<Tick> LogAxis::doubling_ticks(size_t most) const {
    const int first = static_cast<int>(std::ceil(std::log2(low_) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log2(high_) + 1e-9));
    const int step = (last - first) / static_cast<int>(most) + 1;
    std::vector<Tick> ticks;
    for (int power = first; power <= last; power += step)
        ticks.push_back({std::exp2(power), tick_label(std::exp2(power))});
    return ticks;
}

std::vector<Tick> LogAxis::ticks(size_t most) const {
    if (doubling_) return doubling_ticks(most);
    std::vector<Tick> ticks;
    const int first = static_cast<int>(std::floor(std::log10(low_) + 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(high_) + 1e-9));
    const auto collect = [&](std::span<const double> factors, int step) {
        ticks.clear();
        for (int decade = first; decade <= last; ++decade) {
            if (decade % step != 0) continue;
            for (const double factor : factors) {
                const double value = factor * power_of_ten(decade);
                if (value >= low_ * (1 - 1e-9) && value <= high_ * (1 + 1e-9))
                    ticks.push_back({value, tick_label(value)});
            }
        }
        return ticks.size() <= most;
    };
    constexpr std::array<double, 3> all{1, 2, 5};
    constexpr std::array<double, 1> powers{1};
    if (collect(all, 1)) return ticks;
    int step = 1;
    while (!collect(powers, step)) ++step;
    return ticks;
}

LinearAxis::LinearAxis(double highest, double from, double to) : from_(from), to_(to) {
    if (!(highest > 1e-300) || !std::isfinite(highest)) highest = 1;
    step_ = round_up(highest / 5);
    high_ = highest;
}

std::vector<Tick> LinearAxis::ticks() const {
    std::vector<Tick> ticks;
    for (int i = 0; i * step_ <= high_ * (1 + 1e-9); ++i) ticks.push_back({i * step_, tick_label(i * step_)});
    return ticks;
}

}  // namespace strandlab
