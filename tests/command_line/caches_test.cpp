// What earlier runs have left is used, and never believed: damaged entries are as good as none.
#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace strandlab::testing_tools {
namespace {

namespace fs = std::filesystem;

class CachesTest : public CommandLineTest {
  protected:
    /// The row of one case; its model has enough leaves for their order to be kept.
    nlohmann::json row(const std::string& file, const Arguments& more = {}) const {
        Arguments arguments{"bench",        "generate:fur,strands=14000",
                            "--rays",       "primary",
                            "--primitive",  "prhi",
                            "--resolution", "64x36",
                            "--repeat",     "1",
                            "--leaf-order", "median",
                            "--no-embree",  "--quiet",
                            "--json",       file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        if (std::find(more.begin(), more.end(), "--error-rays") == more.end())
            arguments.insert(arguments.end(), {"--error-rays", "500"});
        expect_success(run(arguments));
        return nlohmann::json::parse(read(file));
    }

    std::vector<fs::directory_entry> entries() const {
        std::vector<fs::directory_entry> all;
        for (const auto& entry : fs::recursive_directory_iterator(path("cache")))
            if (entry.path().extension() == ".entry") all.push_back(entry);
        return all;
    }

    /// Changes a byte of every entry; how many there are.
    size_t damage_all() const {
        const std::vector<fs::directory_entry> all = entries();
        for (const auto& entry : all) {
            std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
            const auto middle = static_cast<std::streamoff>(entry.file_size() / 2);
            file.seekg(middle);
            const char byte = static_cast<char>(file.get() ^ 0x55);
            file.seekp(middle);
            file.put(byte);
        }
        return all.size();
    }
};

TEST_F(CachesTest, KeepWhatIsCostlyAndRebuildWhatIsDamaged) {
    SKIP_WITHOUT_DEVICE();
    const nlohmann::json first = row("first.jsonl"), second = row("second.jsonl");
    EXPECT_EQ(first["time"]["order_cached"], false);
    EXPECT_EQ(second["time"]["order_cached"], true);
    ASSERT_GT(damage_all(), 0u);
    const nlohmann::json third = row("third.jsonl"), fourth = row("fourth.jsonl");
    EXPECT_EQ(third["time"]["order_cached"], false);
    EXPECT_EQ(fourth["time"]["order_cached"], true);
    const nlohmann::json without = row("without.jsonl", {"--no-cache"});
    EXPECT_EQ(without["time"]["order_cached"], false);
    for (const nlohmann::json& other : {second, third, fourth, without})
        EXPECT_EQ(first["model_error"], other["model_error"]);
}

TEST_F(CachesTest, WithoutErrorRaysThereIsNoReference) {
    SKIP_WITHOUT_DEVICE();
    row("without.jsonl", {"--error-rays", "0"});
    const size_t without = entries().size();
    row("with.jsonl");
    EXPECT_EQ(entries().size(), without + 2) << "the primitive's own surface and the common one";
}

TEST_F(CachesTest, TheTraversalIsMeasuredOnce) {
    SKIP_WITHOUT_DEVICE();
    const Arguments automatic{"--traversal", "auto"};
    const nlohmann::json first = row("first.jsonl", automatic), second = row("second.jsonl", automatic);
    EXPECT_EQ(first["settings"]["traversal"], "auto");
    EXPECT_NE(first["time"]["traversal"], "auto");
    EXPECT_EQ(first["time"]["traversal"], second["time"]["traversal"]);
    EXPECT_EQ(first["model_error"], second["model_error"]);
}

TEST_F(CachesTest, TraversalsThatThereAreNotAreRefused) {
    expect_failure(run({"bench", "generate:fur,strands=10", "--traversal", "magic"}), 2,
                   {"--traversal magic", "pipeline, query or auto"});
}

TEST_F(CachesTest, MemoryPerCurveIsLimited) {
    SKIP_WITHOUT_DEVICE();
    const nlohmann::json limited = row("limited.jsonl", {"--bytes-per-curve", "300"});
    EXPECT_LE(limited["memory"]["bytes_per_curve"].get<double>(), 300);
    EXPECT_EQ(limited["settings"]["bytes_per_curve"], 300);
    expect_last_line(run({"bench", "generate:fur,strands=10", "--rays", "primary", "--primitive", "prhi",
                          "--resolution", "8x8", "--no-embree", "--bytes-per-curve", "20"}),
                     2, {"--bytes-per-curve 20", "prhi takes at least"});
}

}  // namespace
}  // namespace strandlab::testing_tools
