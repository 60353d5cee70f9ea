// Content hashes for caches and result files (FNV-1a over 8-byte words, mixed at the end).
#pragma once

#include "base/random.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace strandlab {

/// Accumulates a 64-bit content hash; not for security.
class Hash {
  public:
    Hash& add(const void* data, size_t bytes) {
        const auto* p = static_cast<const unsigned char*>(data);
        for (; bytes >= 8; p += 8, bytes -= 8) {
            uint64_t word;
            std::memcpy(&word, p, 8);
            value_ = mix_bits(value_ ^ word);
        }
        uint64_t tail = bytes;
        for (size_t i = 0; i < bytes; ++i) tail = (tail << 8) | p[i];
        value_ = mix_bits(value_ ^ tail ^ (0x5Bull << 56));
        return *this;
    }
    template <class T>
    Hash& add(std::span<const T> items) {
        return add(items.data(), items.size_bytes());
    }
    Hash& add_number(uint64_t word) {
        value_ = mix_bits(value_ ^ word);
        return *this;
    }
    uint64_t value() const { return value_; }

  private:
    uint64_t value_ = 0xCBF29CE484222325ull;
};

}  // namespace strandlab
