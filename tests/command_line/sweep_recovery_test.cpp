// Sweeps of bench that are cut off, resumed, shared among machines, or compared with older ones.
#include "base/random.h"
#include "command_line/sweep.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>
#include <thread>

namespace strandlab::testing_tools {
namespace {

TEST_F(SweepTest, ResumesWithoutDoingAnythingTwice) {
    expect_success(run(sweep({"--json", "r.jsonl", "--csv", "r.csv"})));
    const std::string before = read("r.jsonl"), csv = read("r.csv");
    const Outcome again = run(sweep({"--json", "r.jsonl", "--csv", "r.csv", "--resume"}));
    expect_success(again);
    EXPECT_EQ(read("r.jsonl"), before);
    EXPECT_EQ(read("r.csv"), csv);
    EXPECT_TRUE(contains(again.output, "prhi:splits=2"));  // its table is whole all the same
    // A line that was torn and one that is gone are measured again.
    std::vector<Json> all = rows("r.jsonl");
    const Json last = all.back();
    all.pop_back();
    all.erase(all.begin() + 3);
    write_rows("r.jsonl", all);
    std::ofstream(path("r.jsonl"), std::ios::app) << last.dump().substr(0, 3000);
    const Outcome repaired = run(sweep({"--json", "r.jsonl", "--csv", "r.csv", "--resume"}));
    expect_success(repaired);
    EXPECT_TRUE(contains(repaired.log, "r.jsonl: its last line was torn")) << repaired.log;
    EXPECT_EQ(keys("r.jsonl").size(), cases);
    const std::string table = read("r.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), static_cast<std::ptrdiff_t>(cases + 1));
    expect_failure(run(sweep({"--resume"})), 2, {"--resume", "--json"});
    write("strange", "no rows\n");
    expect_failure(run(sweep({"--resume", "--json", "strange"})), 5, {"strange", "line 1"});
}

TEST_F(SweepTest, SurvivesBeingKilledTwentyTimes) {
    expect_success(run(sweep({"--json", "whole"})));
    const std::set<std::string> expected = keys("whole");
    ASSERT_EQ(expected.size(), cases);
    const bool is_long = std::getenv("STRANDLAB_LONG_TESTS") != nullptr;
    Random random(7);
    int unfinished = 0;
    // The run that the others are cut from takes about a tenth of a second.
    for (int kill = 0; kill < 20; ++kill) {
        const pid_t process = start(sweep({"--json", "r.jsonl", "--csv", "r.csv", "--resume"}));
        std::this_thread::sleep_for(std::chrono::microseconds(random.below(is_long ? 400'000 : 150'000)));
        ::kill(process, SIGKILL);
        int status = 0;
        ::waitpid(process, &status, 0);
        unfinished += WIFSIGNALED(status) ? 1 : 0;
        // Some were too quick: begin anew, so that all twenty strike.
        if (!WIFSIGNALED(status)) {
            EXPECT_EQ(keys("r.jsonl"), expected);
            std::filesystem::remove(path("r.jsonl"));
            std::filesystem::remove(path("r.csv"));
        }
    }
    EXPECT_GT(unfinished, 5);
    expect_success(run(sweep({"--json", "r.jsonl", "--csv", "r.csv", "--resume"})));
    EXPECT_EQ(keys("r.jsonl"), expected);
    const std::string table = read("r.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), static_cast<std::ptrdiff_t>(cases + 1));
    for (const std::string& name : files()) EXPECT_EQ(name.find(".tmp"), std::string::npos) << name;
}

TEST_F(SweepTest, AFullDiskIsSaidAndHurtsNothing) {
    expect_success(run(sweep({"--json", "whole"})));
    // Files of at most 40 blocks of 512 bytes: a row and a half.
    const std::string shell =
        "cd '" + path("") + "' && ulimit -f 40 && XDG_CACHE_HOME=cache '" STRANDLAB_PROGRAM "' ";
    std::string command = shell;
    for (const std::string& word : sweep({"--json", "r.jsonl", "--no-cache"})) command += " '" + word + "'";
    const int status = std::system((command + " > out.txt 2> err.txt").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 5) << read("err.txt");
    EXPECT_TRUE(contains(read("err.txt"), "r.jsonl: cannot append: File too large")) << read("err.txt");
    const size_t kept = rows("r.jsonl").size();
    EXPECT_LT(kept, cases);
    expect_success(run(sweep({"--json", "r.jsonl", "--resume"})));
    EXPECT_EQ(keys("r.jsonl"), keys("whole"));
}

TEST_F(SweepTest, PartsMakeTheWhole) {
    expect_success(run(sweep({"--json", "whole.jsonl"})));
    // As GNU parallel, xargs or a job array would start them: all at once, each in its own file.
    const bool has_parallel = std::system("parallel --version 2> /dev/null | grep -q '^GNU parallel'") == 0;
    std::string shell = "cd '" + path("") + "' && seq 4 | XDG_CACHE_HOME=cache HOME=cache " +
                        (has_parallel ? "parallel -q -j 4" : "xargs -P 4 -I{}") + " '" STRANDLAB_PROGRAM "'";
    for (const std::string& word : sweep({"--json", "part{}.jsonl", "--shard", "{}/4", "--quiet"}))
        shell += " '" + word + "'";
    ASSERT_EQ(std::system((shell + " > out.txt").c_str()), 0);
    std::map<size_t, Json> merged;
    for (const char* part : {"1", "2", "3", "4"}) {
        const std::vector<Json> some = rows("part" + std::string(part) + ".jsonl");
        EXPECT_EQ(some.size(), cases / 4);
        for (const Json& row : some) EXPECT_TRUE(merged.emplace(row.at("sweep").at("case"), row).second);
    }
    const auto comparable = [](Json row) {
        for (const char* field : {"time", "context", "reproduce"}) row.erase(field);
        row.at("sweep").erase("shard");
        row.at("sweep").erase("shards");
        return row;
    };
    for (const Json& row : rows("whole.jsonl")) {
        const size_t number = row.at("sweep").at("case");
        ASSERT_TRUE(merged.contains(number));
        EXPECT_EQ(comparable(merged.at(number)), comparable(row));
    }
    EXPECT_EQ(merged.size(), cases);
    expect_failure(run(sweep({"--shard", "5/4"})), 2, {"--shard 5/4", "I/N"});
}

TEST_F(SweepTest, PartsRunAsASlurmJobArray) {
    // Slurm itself only starts the script, with these variables; here tasks 5 and 6 of a cluster's own count.
    for (const char* task : {"5", "6"}) {
        std::string shell = "cd '" + path("") +
                            "' && XDG_CACHE_HOME=cache STRANDLAB='" STRANDLAB_PROGRAM
                            "' SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_ID=" +
                            task + " '" STRANDLAB_MODELS "/../tools/sweep_array' results";
        Arguments arguments = sweep({"--quiet"});
        for (size_t i = 1; i < arguments.size(); ++i) shell += " '" + arguments[i] + "'";
        ASSERT_EQ(std::system((shell + " > out.txt").c_str()), 0) << shell;
    }
    std::set<std::string> all = keys("results/part1.jsonl");
    EXPECT_EQ(all.size(), cases / 2);
    all.merge(keys("results/part2.jsonl"));
    EXPECT_EQ(all.size(), cases);
    const int status = std::system("bash '" STRANDLAB_MODELS "/../tools/sweep_array' x 2> /dev/null");
    EXPECT_NE(status, 0);
}

TEST_F(SweepTest, ComparesWithABaseline) {
    expect_success(run(sweep({"--json", "old.jsonl"})));
    // Nothing is measured: the same rows, with the times of some changed by hand.
    const auto compare = [&](const std::vector<Json>& changed) {
        write_rows("new.jsonl", changed);
        return run(sweep({"--json", "new.jsonl", "--resume", "--baseline", "old.jsonl"}));
    };
    std::vector<Json> all = rows("old.jsonl");
    for (Json& row : all) row.at("time").at("ratio").at("samples") = {1.0, 1.01, 0.99, 1.0};
    write_rows("old.jsonl", all);
    const Outcome same = compare(all);
    expect_success(same);
    EXPECT_TRUE(contains(same.output, "16 rows compared, times of 12: no difference")) << same.output;

    std::vector<Json> slower = all;
    slower[3].at("time").at("ratio").at("samples") = {2.0, 2.02, 1.98, 2.0};
    const Outcome found = compare(slower);
    EXPECT_EQ(found.code, 1) << found.log;
    EXPECT_TRUE(contains(found.output, "slower, 2.00 times as long")) << found.output;
    EXPECT_TRUE(contains(found.output, "1 worse, 0 better")) << found.output;
    expect_failure(run(sweep({"--baseline", "absent.jsonl"})), 5, {"absent.jsonl"});
}

TEST_F(SweepTest, FindsADeliberateErrorAndAnotherRadius) {
    const auto bench = [&](const char* primitive, const Arguments& more) {
        Arguments arguments{"bench",        "generate:fur,strands=60",
                            "--device",     "cpu-float",
                            "--resolution", "64x48",
                            "--repeat",     "2",
                            "--rays",       "interior",
                            "--primitive",  "lss",
                            "--primitive",  primitive,
                            "--no-embree",  "--baseline-primitive",
                            "lss"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    };
    expect_success(bench("dots", {"--json", "old.jsonl"}));
    // Strips that are wider than the strand.
    const Outcome wider = bench("dots:width=projected", {"--baseline", "old.jsonl"});
    EXPECT_EQ(wider.code, 1) << wider.log;
    EXPECT_TRUE(contains(wider.output, "dots:width=projected (was dots): model_error: ")) << wider.output;
    // All radii 1 % off: other curves, and rays that start elsewhere.
    write_curves(path("a.npy"),
                 {line_curve({0, 0, 0}, {0, 1, 0}, 0.1f), line_curve({1, 0, 0}, {1, 1, 0}, 0.1f)});
    const Arguments radius{
        "bench",       "a.npy",    "--device",    "cpu-float", "--resolution",
        "32x32",       "--repeat", "1",           "--rays",    "primary",
        "--primitive", "lss",      "--no-embree", "--camera",  "eye=0.5,0.5,4:target=0.5,0.5,0"};
    const auto with = [&](Arguments more) {
        more.insert(more.begin(), radius.begin(), radius.end());
        return run(more);
    };
    expect_success(with({"--json", "r.jsonl"}));
    expect_success(with({"--baseline", "r.jsonl"}));
    write_curves(path("a.npy"),
                 {line_curve({0, 0, 0}, {0, 1, 0}, 0.101f), line_curve({1, 0, 0}, {1, 1, 0}, 0.101f)});
    const Outcome other = with({"--baseline", "r.jsonl"});
    EXPECT_EQ(other.code, 1) << other.log;
    EXPECT_TRUE(contains(other.output, "the curves changed")) << other.output;
}

}  // namespace
}  // namespace strandlab::testing_tools
