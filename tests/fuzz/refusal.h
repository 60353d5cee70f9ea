// The one way in which bad input may be refused.
#pragma once

#include "base/error.h"
#include "fuzz/fuzz_target.h"

#include <utility>

namespace strandlab::fuzz {

/// True when the call accepts its input; false when it refuses it with an Error of bad input or wrong use.
template <class Call>
bool accepts(Call&& call) {
    try {
        std::forward<Call>(call)();
        return true;
    } catch (const Error& error) {
        require(error.code == ExitCode::bad_input || error.code == ExitCode::usage,
                std::string("not a refusal of input: ") + error.what());
        require(*error.what() != '\0', "refused without a word");
        return false;
    }
}

}  // namespace strandlab::fuzz
