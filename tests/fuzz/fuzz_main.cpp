// The libFuzzer program: STRANDLAB_FUZZ_TARGET names the target.
#include "fuzz/fuzz_target.h"

#include <tbb/global_control.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>

namespace {

const strandlab::fuzz::FuzzTarget& chosen_target() {
    const char* const name = std::getenv("STRANDLAB_FUZZ_TARGET");
    for (const auto& target : strandlab::fuzz::fuzz_targets())
        if (name && target.name == name) return target;
    std::cerr << "STRANDLAB_FUZZ_TARGET must be one of:";
    for (const auto& target : strandlab::fuzz::fuzz_targets()) std::cerr << ' ' << target.name;
    std::cerr << '\n';
    std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const strandlab::fuzz::FuzzTarget& target = chosen_target();
    // One process a core: threads of its own would only get in each other's way.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    target.run({reinterpret_cast<const std::byte*>(data), size});
    return 0;
}
