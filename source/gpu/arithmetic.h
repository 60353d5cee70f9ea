// What a device's floating-point arithmetic does, found out by asking it: the accuracy of the ray frame
// (shaders/shared/ray_frame.h) hangs on it.
#pragma once

#include "gpu/device.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace strandlab {

/// Facts about products and fma; each is proven by thousands of products whose exact residue is known.
struct Arithmetic {
    /// fma(a, b, c) rounds once. Vulkan allows two roundings, and lavapipe uses them.
    bool fuses_fma = false;
    /// a * b + c rounds twice where it is marked precise, as it must.
    bool keeps_precise = false;
    /// Dekker's splitting gives the exact residue of a product.
    bool exact_products = false;

    /// "fma is fused; products marked precise are not contracted and exact by Dekker's splitting".
    std::string to_string() const;
};

/// One ray for the shader: numbers of any size.
struct ArithmeticProbe {
    std::array<float, 3> origin{};
    float factor = 1;
    std::array<float, 3> direction{};
    float minus_product = 0;  // - fl(factor * direction[0])
    std::array<float, 3> reference{};
    float unused_0 = 0;
    std::array<float, 3> middle{};
    float unused_1 = 0;
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
    float unused_1 = 0;
};
static_assert(sizeof(ArithmeticAnswer) == 64);

/// Runs the shader on the device; hardware_fma: with product errors by fma instead of Dekker's splitting.
std::vector<ArithmeticAnswer> probe_arithmetic(const Device& device, std::span<const ArithmeticProbe> probes,
                                               bool hardware_fma);

/// Asks the device.
Arithmetic arithmetic_of(const Device& device);

/// The same facts about this program's C++, which the CPU versions of the intersectors are compiled with.
Arithmetic arithmetic_of_cpu();

}  // namespace strandlab
