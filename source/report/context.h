// Under what a result came to be: program, machine, time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace strandlab {

/// What every result row says about the program and the machine. Texts are "unknown" where the system
/// does not tell. The machine's name is left out: result files are published.
struct Context {
    std::string version, commit;
    bool modified = false;  // the sources differed from the commit
    std::string compiler, flags, build_type;
    std::string cpu;     // model name
    size_t cores = 0;    // that the program may run on
    size_t threads = 0;  // that it uses (--threads)
    uint64_t memory_bytes = 0;
    uint64_t shaders = 0;  // hash of the SPIR-V of all primitives
    std::string system;    // "Debian GNU/Linux 12 (bookworm), Linux 6.1.0"
    std::string time;      // UTC, "2025-01-31T12:00:00Z", when the context was taken
};

Context current_context();

}  // namespace strandlab
