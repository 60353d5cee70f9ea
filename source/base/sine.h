// Sine and cosine that give the same bits on every machine (library functions do not).
#pragma once

namespace strandlab {

struct SinCos {
    double sin, cos;
};

/// Both for |x| <= 1e6, within 1e-15 near 0 and 1e-10 at the far end. Only + - * and floor are used, so
/// that every IEEE machine agrees where the compiler does not contract (-ffp-contract=off).
SinCos sin_cos(double x);

}  // namespace strandlab
