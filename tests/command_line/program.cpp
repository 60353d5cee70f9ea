#include "command_line/program.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace strandlab::testing_tools {
namespace {

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Everything that happens in the new process before the program does.
[[noreturn]] void become_program(const Arguments& arguments, const Environment& environment,
                                 const std::string& folder, int output, int log) {
    ::setenv("XDG_CACHE_HOME", (folder + "/cache").c_str(), 1);
    for (const char* name : {"NO_COLOR", "STRANDLAB_MODELS", "LP_NUM_THREADS"}) ::unsetenv(name);
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    std::vector<char*> words{const_cast<char*>("strandlab")};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const int nothing = ::open("/dev/null", O_RDONLY);
    const bool ready = ::chdir(folder.c_str()) == 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
                       ::dup2(output, STDOUT_FILENO) >= 0 && ::dup2(log, STDERR_FILENO) >= 0;
    if (ready) ::execv(STRANDLAB_PROGRAM, words.data());
    ::_exit(127);
}

int exit_code_of(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

pid_t launch(const Arguments& arguments, const Environment& environment, const std::string& folder,
             int output, int log) {
    const pid_t process = ::fork();
    if (process < 0) throw std::runtime_error("cannot start a process");
    if (process == 0) become_program(arguments, environment, folder, output, log);
    return process;
}

int open_new(const std::string& path) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0) throw std::runtime_error("cannot write " + path);
    return file;
}

}  // namespace

const Environment no_vulkan{{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}};

std::vector<std::string> Outcome::log_lines() const {
    std::vector<std::string> lines;
    std::istringstream stream(log);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

Outcome CommandLineTest::run(const Arguments& arguments, const Environment& environment) const {
    const int output = open_new(path("stdout.txt")), log = open_new(path("stderr.txt"));
    const int code = exit_code_of(launch(arguments, environment, folder_.path(), output, log));
    ::close(output);
    ::close(log);
    return {code, contents(path("stdout.txt")), contents(path("stderr.txt"))};
}

Outcome CommandLineTest::run_on_terminal(const Arguments& arguments, const Environment& environment) const {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (terminal < 0 || ::grantpt(terminal) != 0 || ::unlockpt(terminal) != 0)
        throw std::runtime_error("no pseudo-terminal");
    const int inner = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY | O_CLOEXEC);
    Environment all{{"TERM", "xterm"}};
    all.insert(all.end(), environment.begin(), environment.end());
    const pid_t process = launch(arguments, all, folder_.path(), inner, inner);
    ::close(inner);
    Outcome outcome;
    std::array<char, 4096> block;
    for (;;) {  // until the last writer closes its end
        const ssize_t bytes = ::read(terminal, block.data(), block.size());
        if (bytes < 0 && errno == EINTR) continue;
        if (bytes <= 0) break;
        outcome.output.append(block.data(), static_cast<size_t>(bytes));
    }
    outcome.code = exit_code_of(process);
    ::close(terminal);
    return outcome;
}

Outcome CommandLineTest::run_for_a_second(const Arguments& arguments, const Environment& environment) const {
    const pid_t process = start(arguments, environment);
    siginfo_t ended{};
    for (int tries = 0; tries < 100 && ended.si_pid == 0; ++tries) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ::waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
    if (ended.si_pid == 0) ::kill(process, SIGKILL);
    const int code = exit_code_of(process);
    return {code, contents(path("stdout.txt")), contents(path("stderr.txt"))};
}

pid_t CommandLineTest::start(const Arguments& arguments, const Environment& environment) const {
    const int output = open_new(path("stdout.txt")), log = open_new(path("stderr.txt"));
    const pid_t process = launch(arguments, environment, folder_.path(), output, log);
    ::close(output);
    ::close(log);
    return process;
}

void CommandLineTest::write(const std::string& name, const std::string& bytes) const {
    std::ofstream file(path(name), std::ios::binary);
    file << bytes;
    ASSERT_TRUE(file.good()) << name;
}

std::string CommandLineTest::read(const std::string& name) const { return contents(path(name)); }

bool CommandLineTest::exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

std::vector<std::string> CommandLineTest::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        const std::string name = entry.path().filename().string();
        if (name != "stdout.txt" && name != "stderr.txt" && name != "cache") names.push_back(name);
    }
    return names;
}

void CommandLineTest::expect_success(const Outcome& outcome) { EXPECT_EQ(outcome.code, 0) << outcome.log; }

void CommandLineTest::expect_failure(const Outcome& outcome, int code,
                                     const std::vector<std::string>& parts) {
    expect_last_line(outcome, code, parts);
    EXPECT_EQ(outcome.log_lines().size(), 1u) << outcome.log;
    EXPECT_EQ(outcome.output, "");
}

void CommandLineTest::expect_last_line(const Outcome& outcome, int code,
                                       const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.code, code) << outcome.log;
    const std::vector<std::string> lines = outcome.log_lines();
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(outcome.log.back(), '\n');
    for (const std::string& line : lines) EXPECT_EQ(line.rfind("strandlab: ", 0), 0u) << line;
    for (const std::string& part : parts)
        EXPECT_TRUE(contains(lines.back(), part)) << "lacks '" << part << "': " << lines.back();
}

const std::string& CommandLineTest::why_no_device() const {
    static const std::string why = [this] {
        const Outcome info = run({"info"});
        if (info.code != 0) return "strandlab info: " + info.output.substr(0, 300) + info.log;
        if (!contains(info.output, " traversal, pipelines"))
            return std::string("strandlab info names no device that can trace rays");
        return std::string();
    }();
    return why;
}

}  // namespace strandlab::testing_tools
