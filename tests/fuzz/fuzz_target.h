// What is fuzzed: one function for every parser and every intersector. The fuzzer and an ordinary test (which
// replays what was ever found) call the same functions.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab::fuzz {

using Bytes = std::span<const std::byte>;

struct FuzzTarget {
    std::string_view name;
    /// Takes any bytes. A finding is whatever it throws; an Error that the program may end with is none.
    void (*run)(Bytes input);
    /// Inputs to start from.
    std::vector<std::string> (*seeds)();
};

/// All targets.
std::span<const FuzzTarget> fuzz_targets();

/// A finding unless the condition holds.
inline void require(bool condition, const std::string& finding) {
    if (!condition) throw std::logic_error(finding);
}

}  // namespace strandlab::fuzz
