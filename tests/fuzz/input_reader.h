// Takes values off the bytes of a fuzzer; zeros after their end.
#pragma once

#include "fuzz/fuzz_target.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace strandlab::fuzz {

class InputReader {
  public:
    explicit InputReader(Bytes input) : rest_(input) {}

    template <class T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        const size_t bytes = std::min(sizeof(T), rest_.size());
        if (bytes > 0) std::memcpy(&value, rest_.data(), bytes);
        rest_ = rest_.subspan(bytes);
        return value;
    }

    uint32_t below(uint32_t n) { return take<uint8_t>() % n; }

    /// At most `bytes` of what is left.
    Bytes part(size_t bytes) {
        const Bytes taken = rest_.subspan(0, std::min(bytes, rest_.size()));
        rest_ = rest_.subspan(taken.size());
        return taken;
    }

    Bytes rest() const { return rest_; }

    /// What is left as the text of an option, which ends at its first zero byte.
    std::string text() const {
        const std::string bytes(reinterpret_cast<const char*>(rest_.data()), rest_.size());
        return bytes.substr(0, bytes.find('\0'));
    }

  private:
    Bytes rest_;
};

}  // namespace strandlab::fuzz
