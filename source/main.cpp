// Chooses the command and turns every error into one line and an exit code.
#include "base/error.h"
#include "base/log.h"
#include "commands/command.h"

#include <cstdio>
#include <exception>
#include <new>

int main(int argc, char** argv) {
    using namespace strandlab;
    try {
        return run_command_line(argc, argv);
    } catch (const Error& error) {
        fmt::print(stderr, "strandlab: {}\n", error.what());
        return static_cast<int>(error.code);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "strandlab: out of memory; try a smaller model or fewer rays\n");
        return static_cast<int>(ExitCode::device_lost);
    } catch (const std::exception& error) {
        fmt::print(stderr, "strandlab: {}\n", error.what());
        return static_cast<int>(ExitCode::bad_input);
    }
}
