#include "fuzz/load_bytes.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace strandlab;
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
    load_bytes(".hair", bytes, static_cast<Basis>(size % 4));
    return 0;
}
