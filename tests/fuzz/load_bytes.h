// Runs bytes through the reader of an extension, as the program would, and checks what comes out.
#pragma once

#include "base/error.h"
#include "strands/models.h"

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace strandlab {

/// Throws std::logic_error (which is a finding) when curves break the invariants of strands/curves.h.
inline void require_invariants(const Curves& curves) {
    uint64_t next = 0;
    for (const StrandRange& strand : curves.strands) {
        if (strand.first != next || strand.count == 0) throw std::logic_error("strands leave holes");
        next += strand.count;
    }
    if (next != curves.curves.size()) throw std::logic_error("strands do not cover the curves");
    for (const Curve& curve : curves.curves)
        for (const glm::vec4& p : curve)
            if (!(p.w >= 0 && p.w < 1e30f) || !(glm::dot(glm::abs(glm::vec3(p)), glm::vec3(1)) < 1e30f))
                throw std::logic_error("a number is not finite or a radius is negative");
}

/// True when the call accepts the file "input"; false when it refuses it with an Error (bad_input) of one
/// line that names it. Anything else is a finding: std::logic_error.
template <class Call>
bool accepts_input(const Call& call) {
    try {
        call();
        return true;
    } catch (const Error& error) {
        const std::string text = error.what();
        if (error.code != ExitCode::bad_input || text.find("input") == std::string::npos ||
            text.find('\n') != std::string::npos)
            throw std::logic_error("not one line of bad input: " + text);
        return false;
    }
}

/// Whether the reader of an extension accepts the bytes.
inline bool load_bytes(std::string_view extension, std::span<const std::byte> bytes, Basis basis,
                       const ByteSource* strands = nullptr) {
    const ByteSource source = ByteSource::from_memory("input", bytes);
    CurveOptions options;
    options.basis = basis;
    ImportReport report;
    for (const ModelFormat& format : model_formats())
        if (format.extension == extension)
            return accepts_input([&] {
                require_invariants(format.load({source, strands, options, report}));
            });
    throw std::logic_error("no such format");
}

}  // namespace strandlab
