#include "base/build_info.h"
#include "base/cache.h"
#include "base/error.h"
#include "base/log.h"
#include "commands/command.h"
#include "commands/usage_error.h"

#include <tbb/global_control.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <vector>

namespace strandlab {
namespace {

std::vector<Command> all_commands() {
    return {bench_command(),   validate_command(), stress_command(),   trace_command(),
            compare_command(), render_command(),   generate_command(), lod_command(),
            convert_command(), report_command(),   info_command()};
}

/// Options of every command.
struct GlobalOptions {
    uint32_t threads = 0;
    bool quiet = false;
    bool no_cache = false;
};

void add_global_options(CLI::App& app, GlobalOptions& options) {
    app.add_option("--threads", options.threads,
                   "processor threads to use (0: all); results do not depend on it")
        ->default_str("0")
        ->check(whole_number(0, 4096));
    app.add_flag("--quiet", options.quiet, "no progress and no information on standard error");
    app.add_flag("--no-cache", options.no_cache, "neither read nor write $XDG_CACHE_HOME/strandlab");
}

}  // namespace

std::string version_text() {
    const BuildInfo& info = build_info();
    return fmt::format("{} (commit {}{}), {} {}", info.version, info.commit.substr(0, 8),
                       info.modified ? ", modified" : "", info.compiler, info.build_type);
}

int run_command_line(int argc, char** argv) {
    const std::vector<Command> commands = all_commands();
    CLI::App app("Which primitive to ray-trace hair with, and what it costs in time, memory and error.",
                 "strandlab");
    app.set_version_flag("--version", fmt::format("strandlab {}", version_text()));
    app.require_subcommand(1);
    app.fallthrough();
    app.footer(
        "Exit codes: 0 ok, 1 a threshold exceeded, 2 usage, 3 no device or feature,\n"
        "4 device lost or out of memory, 5 bad input.\n"
        "Help of a command, with examples: strandlab COMMAND --help");
    GlobalOptions global;
    add_global_options(app, global);
    RunCommand run;
    for (const Command& command : commands) {
        CLI::App* sub = app.add_subcommand(command.name, command.summary);
        sub->footer("Examples:\n" + command.examples);
        RunCommand body = command.declare(*sub);
        sub->callback([&run, body] { run = body; });
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);  // help and version
    } catch (const CLI::ParseError& error) {
        fail_usage(app, error);
    }
    std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the size limit is an error like a full disk, not the end
    set_quiet(global.quiet);
    set_cache_enabled(!global.no_cache);
    std::unique_ptr<tbb::global_control> limit;
    if (global.threads > 0) {
        limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                      global.threads);
        setenv("LP_NUM_THREADS", std::to_string(global.threads).c_str(), 0);  // lavapipe's
    }
    return run();
}

}  // namespace strandlab
