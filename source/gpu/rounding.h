// SPIR-V that rounds as C++ does. Vulkan lets drivers fuse a product with a sum, and be off by 2.5 ulp in a
// quotient: faster, and no two devices say the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strandlab {

/// How a shader is made to round.
struct ShaderRounding {
    bool alike = false;            // as C++
    bool mends_quotients = false;  // and roots, where the device rounds them badly and fuses fma
};

/// The same module with every float sum and product rounded by itself (NoContraction). mends_quotients, for
/// devices that fuse fma and round quotients or roots badly: these are corrected by the residue that fma
/// gives (Markstein, "Computation of elementary functions on the IBM RISC System/6000 processor", 1990), to
/// the nearest float for all but about one in a million, and for numbers whose residues do not underflow.
/// Of built-in functions sqrt and mix are written out; the shaders do without others that round
/// (shared/portable.h).
std::vector<uint32_t> rounded_alike(std::span<const uint32_t> module, bool mends_quotients);

}  // namespace strandlab
