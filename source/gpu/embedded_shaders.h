// The SPIR-V inside the program.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace strandlab {

/// SPIR-V of a shader by its file name ("lss.rint"); empty when there is none.
std::span<const uint32_t> embedded_shader(std::string_view name);

/// Content hash of all of them.
uint64_t embedded_shader_hash();

}  // namespace strandlab
