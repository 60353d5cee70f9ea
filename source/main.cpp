// Chooses the command and turns every error into one line and an exit code.
#include "base/error.h"
#include "base/terminal.h"
#include "base/text.h"
#include "commands/command.h"

#include <exception>
#include <new>

namespace strandlab {
namespace {

int fail_with(ExitCode code, const char* message) {
    write_message("strandlab: " + one_line(message));
    return static_cast<int>(code);
}

}  // namespace
}  // namespace strandlab

int main(int argc, char** argv) {
    using namespace strandlab;
    try {
        return run_command_line(argc, argv);
    } catch (const Error& error) {
        return fail_with(error.code, error.what());
    } catch (const std::bad_alloc&) {
        return fail_with(ExitCode::device_lost, "out of memory; try a smaller model or fewer rays");
    } catch (const std::exception& error) {
        return fail_with(ExitCode::bad_input, error.what());
    }
}
