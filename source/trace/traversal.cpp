#include "trace/traversal.h"

#include "base/error.h"

namespace strandlab {

std::string_view name_of(Traversal traversal) {
    switch (traversal) {
        case Traversal::query: return "query";
        case Traversal::automatic: return "auto";
        default: return "pipeline";
    }
}

Traversal parse_traversal(std::string_view text) {
    for (const Traversal one : {Traversal::pipeline, Traversal::query, Traversal::automatic})
        if (text == name_of(one)) return one;
    fail(ExitCode::usage, "--traversal {}: must be pipeline, query or auto", text);
}

}  // namespace strandlab
