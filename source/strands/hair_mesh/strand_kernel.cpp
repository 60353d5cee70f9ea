#include "strands/hair_mesh/strand_kernel.h"

#include "base/sine.h"
#include "strands/generator_parts.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace strandlab {
namespace {

/// 1 / x, so large for 0 that everything beyond the root is full.
float rise_over(double x) { return x > 1e-6 ? static_cast<float>(1 / x) : 1e6f; }

}  // namespace

StrandStyle strand_style(const Parameters& parameters) {
    const auto number = [&](const char* key) { return static_cast<float>(parameters.number(key)); };
    const auto direction = [&](const char* key) { return sin_cos(parameters.number(key) * (tau / 360)); };
    const auto rise = [&](const char* key) { return rise_over(parameters.number(key)); };
    StrandStyle s{};
    s.kept_length = number("length");
    s.cut = number("cut");
    s.cut_noise = number("cut_noise");
    s.cut_frequency = number("cut_frequency");
    s.clump = number("clump");
    s.clump_start = number("clump_start");
    s.clump_rise = rise_over(1 - parameters.number("clump_start"));
    s.curl = number("curl");
    s.curl_frequency = number("curl_frequency");
    s.curl_rise = rise("curl_ramp");
    s.curl_coherence = number("curl_coherence");
    s.wave = number("wave");
    s.wave_frequency = number("wave_frequency");
    s.wave_rise = rise("wave_ramp");
    s.wave_spread = number("wave_spread");
    s.wave_u = static_cast<float>(direction("wave_angle").cos);
    s.wave_v = static_cast<float>(direction("wave_angle").sin);
    s.kink = number("kink");
    s.kink_frequency = number("kink_frequency");
    s.kink_rise = rise("kink_ramp");
    s.kink_spread = number("kink_spread");
    s.kink_u = static_cast<float>(direction("kink_angle").cos);
    s.kink_v = static_cast<float>(direction("kink_angle").sin);
    s.noise = number("noise");
    s.noise_across = number("noise_across");
    s.noise_along = number("noise_along");
    s.frizz = number("frizz");
    s.frizz_frequency = number("frizz_frequency");
    s.rise = rise("ramp");
    s.fuzz = number("fuzz");
    s.fuzz_share = number("fuzz_share");
    return s;
}

kernels::HairStrandKernel<double>::StrandStyle to_double(const StrandStyle& style) {
    using Double = kernels::HairStrandKernel<double>::StrandStyle;
    static_assert(sizeof(Double) == 2 * sizeof(StrandStyle), "both hold the same numbers and nothing else");
    constexpr size_t count = sizeof(StrandStyle) / sizeof(float);
    std::array<float, count> numbers;
    std::array<double, count> doubles;
    std::memcpy(numbers.data(), &style, sizeof(style));
    std::copy(numbers.begin(), numbers.end(), doubles.begin());
    Double result;
    std::memcpy(&result, doubles.data(), sizeof(result));
    return result;
}

}  // namespace strandlab
