// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace strandlab {

/// A number with so many significant digits: plain from 0.001 to a million ("0.0123", "123457"), otherwise
/// with an exponent ("1.23e-05"). "nan", "inf" and "-inf" are written out.
std::string significant(double value, int digits = 3);

/// A count with its digits in groups of three: "1,234,567".
std::string grouped(uint64_t count);

/// A size: "17 B", "1.25 kB", "64.0 MB", in powers of 1000.
std::string bytes_text(uint64_t bytes);

/// A share as a percentage with two significant digits: "0.013 %", "100 %".
std::string percent(double share);

}  // namespace strandlab
