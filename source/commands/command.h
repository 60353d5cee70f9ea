// The commands of the program. Adding one: a file that declares it, and one line in command_line.cpp.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace strandlab {

/// Runs a command whose options have been parsed; returns the exit code.
using RunCommand = std::function<int()>;

/// A command: its name, one line for the list, examples for its own help, and a function that declares
/// its options and returns what runs it.
struct Command {
    std::string name, summary, examples;
    RunCommand (*declare)(CLI::App& app);
};

Command bench_command();
Command compare_command();
Command convert_command();
Command generate_command();
Command info_command();
Command lod_command();
Command render_command();
Command report_command();
Command stress_command();
Command trace_command();
Command validate_command();

/// "0.1.0 (commit 1234abcd, modified), GNU 12.2.0 Release".
std::string version_text();

/// Parses the command line and runs the command. Errors of usage exit with 2 and one line.
int run_command_line(int argc, char** argv);

}  // namespace strandlab
