// Rows of bench: the same every time, appended, whole.
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <sstream>
#include <sys/wait.h>
#include <thread>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::json;

class BenchTest : public CommandLineTest {
  protected:
    Outcome bench(const Arguments& more, const std::string& device = "cpu-float") const {
        Arguments arguments{"bench", "generate:fur,strands=60", "--resolution", "40x24", "--repeat", "1"};
        if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    std::vector<std::string> lines(const std::string& name) const {
        std::vector<std::string> all;
        std::istringstream stream(read(name));
        for (std::string line; std::getline(stream, line);) all.push_back(line);
        return all;
    }

    /// The rows of a file without what is allowed to differ: times, and under what they were taken.
    std::vector<Json> rows(const std::string& name) const {
        std::vector<Json> all;
        for (const std::string& line : lines(name)) {
            Json row = Json::parse(line);
            row.erase("time");
            row.erase("context");
            all.push_back(std::move(row));
        }
        return all;
    }

    void expect_same_rows(const std::string& device) const {
        expect_success(bench({"--json", "cold"}, device));
        expect_success(bench({"--json", "warm"}, device));
        expect_success(bench({"--json", "one", "--no-cache", "--threads", "1"}, device));
        expect_success(bench({"--json", "two", "--no-cache", "--threads", "2"}, device));
        const std::vector<Json> expected = rows("cold");
        ASSERT_GE(expected.size(), 8u);  // two ray sets, four primitives
        for (const char* name : {"warm", "one", "two"}) {
            const std::vector<Json> found = rows(name);
            ASSERT_EQ(found.size(), expected.size());
            for (size_t i = 0; i < found.size(); ++i)
                EXPECT_EQ(found[i], expected[i]) << name << ": " << Json::diff(expected[i], found[i]).dump(1);
        }
    }
};

TEST_F(BenchTest, GivesTheSameRowsOnTheProcessor) { expect_same_rows("cpu-float"); }

TEST_F(BenchTest, GivesTheSameRowsOnTheDevice) {
    SKIP_WITHOUT_DEVICE();
    expect_same_rows("");
}

TEST_F(BenchTest, OtherSeedsGiveOtherRows) {
    expect_success(bench({"--json", "a", "--rays", "secondary", "--primitive", "lss"}));
    expect_success(bench({"--json", "b", "--rays", "secondary", "--primitive", "lss", "--seed", "2"}));
    EXPECT_EQ(rows("a").at(0).at("model"), rows("b").at(0).at("model"));
    EXPECT_NE(rows("a").at(0).at("rays").at("hash"), rows("b").at(0).at("rays").at("hash"));
}

TEST_F(BenchTest, AppendsRows) {
    const Arguments arguments{"--json",      "r.jsonl", "--csv",  "r.csv",   "--primitive", "lss",
                              "--primitive", "prhi",    "--rays", "primary", "--no-embree"};
    expect_success(bench(arguments));
    const std::string first = read("r.jsonl"), first_csv = read("r.csv");
    EXPECT_EQ(lines("r.jsonl").size(), 2u);
    EXPECT_EQ(lines("r.csv").size(), 3u);  // and the columns
    expect_success(bench(arguments));
    EXPECT_EQ(lines("r.jsonl").size(), 4u);
    EXPECT_EQ(lines("r.csv").size(), 5u);
    EXPECT_EQ(read("r.jsonl").substr(0, first.size()), first);
    EXPECT_EQ(read("r.csv").substr(0, first_csv.size()), first_csv);
    EXPECT_EQ(rows("r.jsonl").at(0), rows("r.jsonl").at(2));
    EXPECT_EQ(rows("r.jsonl").at(1).at("primitive").at("name"), "prhi");

    write("other.csv", "a,b\n1,2\n");
    expect_failure(bench({"--csv", "other.csv"}), 5, {"other.csv", "columns"});
    EXPECT_EQ(read("other.csv"), "a,b\n1,2\n");
    for (const char* option : {"--json", "--csv"}) {
        expect_failure(bench({option, "nowhere/r"}), 5, {"nowhere/r", "cannot append", "No such file"});
        expect_failure(bench({option, "cache"}), 5, {"cache", "cannot append", "directory"});
    }
}

TEST_F(BenchTest, KeepsItsCacheWhereItShould) {
    expect_success(bench({"--no-cache", "--primitive", "lss"}));
    EXPECT_FALSE(exists("cache"));
    expect_success(bench({"--primitive", "lss"}));
    EXPECT_TRUE(exists("cache/strandlab"));
    // Entries that are damaged count as absent.
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("cache")))
        if (entry.is_regular_file()) std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
    expect_success(bench({"--json", "damaged"}));
    expect_success(bench({"--json", "fresh", "--no-cache"}));
    EXPECT_EQ(rows("damaged"), rows("fresh"));
}

TEST_F(BenchTest, LosesAtMostALineWhenItIsKilled) {
    const pid_t process =
        start({"bench", "generate:fur,strands=60", "generate:fur,strands=61", "generate:fur,strands=62",
               "generate:fur,strands=63", "--device", "cpu-float", "--resolution", "96x54", "--repeat", "50",
               "--json", "r.jsonl"});
    // Two of more than forty rows.
    bool ended = false;
    while (lines("r.jsonl").size() < 2 && !ended) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ended = ::waitpid(process, nullptr, WNOHANG) != 0;
    }
    ASSERT_FALSE(ended) << read("stderr.txt");
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    // The kernel itself may stop a write that is killed between two pages: only the last line may be torn,
    // and the next run cuts it off.
    std::vector<std::string> left = lines("r.jsonl");
    if (read("r.jsonl").back() != '\n') left.pop_back();
    EXPECT_FALSE(left.empty());
    for (const std::string& line : left) EXPECT_TRUE(Json::accept(line)) << line;
    expect_success(bench({"--json", "r.jsonl", "--primitive", "lss"}));
    EXPECT_EQ(read("r.jsonl").back(), '\n');
    for (const std::string& line : lines("r.jsonl")) EXPECT_TRUE(Json::accept(line)) << line;
}

}  // namespace
}  // namespace strandlab::testing_tools
