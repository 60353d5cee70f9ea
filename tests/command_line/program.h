// Runs the program as its users do: arguments in; exit code, standard output and standard error out.
#pragma once

#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace strandlab::testing_tools {

using Arguments = std::vector<std::string>;
using Environment = std::vector<std::pair<std::string, std::string>>;

/// What a run left behind. A run that a signal ended has the code 128 + signal.
struct Outcome {
    int code = -1;
    std::string output, log;  // standard output, standard error

    std::vector<std::string> log_lines() const;
};

/// Without any Vulkan driver.
extern const Environment no_vulkan;

/// A folder of its own for each test: the program's working folder, with its cache in "cache".
class CommandLineTest : public testing::Test {
  protected:
    Outcome run(const Arguments& arguments, const Environment& environment = {}) const;
    /// Ends the run after a second: whatever was wrong with its arguments it has said by then.
    Outcome run_for_a_second(const Arguments& arguments, const Environment& environment = {}) const;
    /// Standard output and error are one terminal (what it shows is `output`).
    Outcome run_on_terminal(const Arguments& arguments, const Environment& environment = {}) const;
    /// Starts a run and returns its process, which the caller waits for.
    pid_t start(const Arguments& arguments, const Environment& environment = {}) const;

    std::string path(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& bytes) const;
    std::string read(const std::string& name) const;
    bool exists(const std::string& name) const;
    /// Names of all files in the folder, those the runs themselves make left out.
    std::vector<std::string> files() const;

    /// Fails the test where a run that should succeed has not.
    static void expect_success(const Outcome& outcome);
    /// Expects an exit code and, as the only line on standard error, one that begins with "strandlab: " and
    /// holds all parts; nothing on standard output.
    static void expect_failure(const Outcome& outcome, int code, const std::vector<std::string>& parts);
    /// The same, but warnings may precede the line and results be on standard output.
    static void expect_last_line(const Outcome& outcome, int code, const std::vector<std::string>& parts);

    /// Why tests on a Vulkan device cannot run here; empty when they can.
    const std::string& why_no_device() const;

  private:
    TestFolder folder_;
};

#define SKIP_WITHOUT_DEVICE() \
    if (!why_no_device().empty()) GTEST_SKIP() << why_no_device()

}  // namespace strandlab::testing_tools
