// The strands file that goes with curves: the curves are valid, the strands hostile.
#include "fuzz/load_bytes.h"
#include "fuzz/samples.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace strandlab;
    static const std::string curves = samples::npy_curves(4);
    const ByteSource strands =
        ByteSource::from_memory("input strands", {reinterpret_cast<const std::byte*>(data), size});
    load_bytes(".npy", samples::as_bytes(curves), Basis::centripetal, &strands);
    return 0;
}
