// The styling of strands, the same text as on the device: float is the reference, double checks it.
#pragma once

#include "base/kernel.h"
#include "base/parameters.h"

namespace strandlab {
namespace kernels {

template <class real>
struct HairStrandKernel {
    STRANDLAB_KERNEL_TYPES
#include "shaders/strands/hair_strand.h"
#include "shaders/strands/root_place.h"
#include "shaders/strands/strand_curve.h"
};

}  // namespace kernels

using HairStrandKernel = kernels::HairStrandKernel<float>;
using StrandStyle = HairStrandKernel::StrandStyle;

/// The style as the kernel reads it.
StrandStyle strand_style(const Parameters& parameters);

/// The same numbers in double.
kernels::HairStrandKernel<double>::StrandStyle to_double(const StrandStyle& style);

}  // namespace strandlab
