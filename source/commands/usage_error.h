// What is wrong with a command line that could not be parsed, in one line.
#pragma once

#include <CLI/CLI.hpp>

namespace strandlab {

/// Throws Error (usage) that names the option or command that was not understood, with the nearest one that
/// there is, or says in CLI11's words which value is missing or out of range; and where the help is.
[[noreturn]] void fail_usage(const CLI::App& app, const CLI::ParseError& error);

/// For options with whole numbers: CLI11 itself lets -1 and numbers above 2^64 - 1 wrap around.
CLI::Validator whole_number(uint64_t low, uint64_t high);

}  // namespace strandlab
