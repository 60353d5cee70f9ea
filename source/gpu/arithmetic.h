// What a device's floating-point arithmetic does, found out by asking it: the accuracy of the ray frame
// (shaders/shared/ray_frame.h) hangs on it, and whether two devices say the same bits.
#pragma once

#include "gpu/device.h"
#include "gpu/rounding.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// Facts, each proven by thousands of operations whose exact result is known.
struct Arithmetic {
    /// fma(a, b, c) rounds once. Vulkan allows two roundings, and lavapipe uses them.
    bool fuses_fma = false;
    /// a * b + c rounds twice where it is marked precise, as it must.
    bool keeps_precise = false;
    /// Dekker's splitting gives the exact residue of a product.
    bool exact_products = false;
    /// a * b + c rounds once where nothing forbids it.
    bool contracts = false;
    /// Some a / b, some square root, is not the nearest float.
    bool rough_quotients = false, rough_roots = false;

    /// Whether C++ gives other bits.
    bool rounds_loosely() const { return contracts || rough_quotients || rough_roots; }
    /// What makes a shader give the bits of C++ here.
    ShaderRounding alike() const { return {true, fuses_fma && (rough_quotients || rough_roots)}; }
    /// "fma is fused; precise products are not contracted, Dekker's splitting is exact; ...".
    std::string to_string() const;
};

/// One ray for the shader: numbers of any size.
struct ArithmeticProbe {
    std::array<float, 3> origin{};
    float factor = 1;
    std::array<float, 3> direction{};
    float minus_product = 0;  // - fl(factor * direction[0])
    std::array<float, 3> reference{};
    float base = 1;
    std::array<float, 3> middle{};
    float minus_square = 0;  // - fl(base^2)
};
static_assert(sizeof(ArithmeticProbe) == 64);

/// What arithmetic.comp found.
struct ArithmeticAnswer {
    std::array<float, 3> fma_residue{};  // of factor * direction
    float sum = 0;                       // factor * direction[0] + minus_product
    std::array<float, 3> dekker_residue{};
    float t_foot = 0;             // of the ray frame: origin + t_foot direction is next to the reference
    std::array<float, 3> foot{};  // that point relative to the reference, as the frame has it
    float unused_0 = 0;
    std::array<float, 3> plain_foot{};  // and without the frame's corrections
    float loose_sum = 0;                // base^2 + minus_square, which the driver may contract
    float quotient = 0;                 // factor / direction[0]
    float root = 0;                     // of factor
    float unused_1[2] = {};
};
static_assert(sizeof(ArithmeticAnswer) == 80);

/// How the probing shader is compiled.
struct ArithmeticProbing {
    bool hardware_fma = false;  // product errors by fma instead of Dekker's splitting
    ShaderRounding rounding;
};

/// Runs the shader on the device.
std::vector<ArithmeticAnswer> probe_arithmetic(const Device& device, std::span<const ArithmeticProbe> probes,
                                               const ArithmeticProbing& probing);

/// Asks the device, or what it does with shaders that are compiled in another way.
Arithmetic arithmetic_of(const Device& device, const ArithmeticProbing& probing = {});

/// The same facts about this program's C++, which the CPU versions of the intersectors are compiled with.
Arithmetic arithmetic_of_cpu();

}  // namespace strandlab
