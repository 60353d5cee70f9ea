// Counter-based random numbers that are the same on every machine and for any number of threads.
#pragma once

#include <cstdint>

namespace strandlab {

/// Mixes 64 bits (the finaliser of splitmix64, Steele et al. 2014).
constexpr uint64_t mix_bits(uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// PCG32 (O'Neill 2014, XSH RR 64/32): one independent generator per (seed, stream, index), so that
/// item i draws the same numbers whoever computes it.
class Random {
  public:
    explicit Random(uint64_t seed, uint64_t stream = 0, uint64_t index = 0) {
        const uint64_t key = mix_bits(mix_bits(mix_bits(seed) + stream) ^ (index * 0xD1342543DE82EF95ull));
        increment_ = (mix_bits(key ^ 0xA5A5A5A5A5A5A5A5ull) << 1) | 1u;
        state_ = key + increment_;
        bits();
    }

    /// 32 uniform bits.
    uint32_t bits() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto x = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto rotation = static_cast<uint32_t>(old >> 59);
        return (x >> rotation) | (x << ((32u - rotation) & 31u));
    }

    /// An integer in [0, n).
    uint32_t below(uint32_t n) { return static_cast<uint32_t>((static_cast<uint64_t>(bits()) * n) >> 32); }

    /// A double in the open interval (0, 1).
    double uniform() { return (static_cast<double>(bits()) + 0.5) * (1.0 / 4294967296.0); }

    /// A double in (low, high).
    double range(double low, double high) { return low + (high - low) * uniform(); }

    /// A double in (-1, 1).
    double signed_unit() { return 2.0 * uniform() - 1.0; }

  private:
    uint64_t state_ = 0, increment_ = 0;
};

}  // namespace strandlab
