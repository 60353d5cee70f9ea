// strandlab stress: its tables and files, and that what it writes can be replayed.
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::json;

class StressTest : public CommandLineTest {
  protected:
    std::vector<Json> json_lines(const std::string& name) const {
        std::vector<Json> objects;
        std::istringstream lines(read(name));
        for (std::string line; std::getline(lines, line);) objects.push_back(Json::parse(line));
        return objects;
    }
};

TEST_F(StressTest, ThePairsThatItCallsWorstAreWrongWhenTheyAreTracedAgain) {
    const Outcome outcome =
        run({"stress", "--primitive", "rocaps:variant=published", "--family", "grazing", "--device",
             "cpu-float", "--pairs", "300", "--worst-folder", "worst", "--worst", "2", "--json",
             "cells.jsonl", "--heat-map", "map.svg", "--embree-pairs", "0"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.output.find("FAILS: grazing, rocaps:variant=published, cpu-float"), std::string::npos)
        << outcome.output;
    EXPECT_EQ(read("map.svg").rfind("<svg", 0), 0u);
    const std::vector<Json> cells = json_lines("cells.jsonl");
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0].at("pairs"), 300);
    EXPECT_EQ(cells[0].at("verdict"), "FAILS");
    EXPECT_GT(cells[0].at("iterations").at("mean").get<double>(), 1.0);
    EXPECT_EQ(cells[0].at("lost_by_boxes").at("count"), 0);

    size_t replayed = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path("worst"))) {
        const std::string curves = entry.path();
        const size_t end = curves.rfind(".curves.npy");
        if (end == std::string::npos) continue;
        const std::string rays = curves.substr(0, end) + ".rays.npy";
        expect_success(run({"trace", "--curves", curves, "--rays", rays, "--primitive",
                            "rocaps:variant=published", "--device", "cpu-float", "--out", "hits"}));
        const Outcome compared = run({"compare", "--curves", curves, "--rays", rays, "--hits", "hits",
                                      "--surface", "rocaps", "--json"});
        expect_success(compared);
        const Json decisive = Json::parse(compared.output).at("decisive");
        int wrong = 0;
        for (const char* error : {"nan", "false_hit", "false_miss", "wrong_place"})
            wrong += decisive.at(error).at("count").get<int>();
        EXPECT_EQ(wrong, 1) << curves << "\n" << compared.output;
        ++replayed;
    }
    EXPECT_EQ(replayed, 2u);
}

TEST_F(StressTest, RaysLeaveHits) {
    const Outcome outcome = run({"stress", "--self-intersection", "--family", "gentle", "--pairs", "100",
                                 "--primitive", "lss", "--primitive", "dots", "--json", "cells.jsonl"});
    expect_success(outcome);
    const std::vector<Json> cells = json_lines("cells.jsonl");
    ASSERT_EQ(cells.size(), 2u);
    for (const Json& cell : cells) {
        EXPECT_EQ(cell.at("verdict"), "holds");
        EXPECT_EQ(cell.at("device"), "cpu-float");
        EXPECT_EQ(cell.at("self_hits").at("count"), 0);
        EXPECT_EQ(cell.at("rays").get<int>(), 4 * cell.at("hits").get<int>());
        EXPECT_GT(cell.at("hits").get<int>(), 50);
    }
    EXPECT_GT(cells[1].at("needs").at("ulps").get<double>(), 0.0);
}

TEST_F(StressTest, BoxesAreWatertight) {
    const Outcome outcome = run({"stress", "--watertight", "--pairs", "200", "--family", "gentle", "--family",
                                 "far 1e6", "--json", "cells.jsonl"});
    expect_success(outcome);
    EXPECT_NE(outcome.output.find("1,600 pairs"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find(" leaf hits, 0 lost by a slab test in float, 0 outside of their box"),
              std::string::npos)
        << outcome.output;
    EXPECT_EQ(json_lines("cells.jsonl").size(), 8u);
}

TEST_F(StressTest, ADeviceAgreesWithTheFloatVersion) {
    SKIP_WITHOUT_DEVICE();
    const Outcome outcome = run({"stress", "--agree", "cpu-float", "--pairs", "300", "--family", "gentle",
                                 "--family", "far 1e4", "--json", "cells.jsonl"});
    expect_success(outcome);
    const std::vector<Json> cells = json_lines("cells.jsonl");
    ASSERT_EQ(cells.size(), 8u);
    for (const Json& cell : cells)
        EXPECT_EQ(cell.at("verdict"), cell.at("primitive") == "dots" ? "not judged" : "holds") << cell;
    const Outcome alike =
        run({"stress", "--agree", "cpu-float", "--pairs", "300", "--family", "grazing", "--primitive", "lss",
             "--no-skip", "rounding", "--quiet", "--json", "alike.jsonl"});
    expect_success(alike);
    EXPECT_EQ(json_lines("alike.jsonl").at(0).at("no_skips"), Json::array({"rounding"}));
    EXPECT_NE(alike.output.find("as C++ does"), std::string::npos) << alike.output;
}

TEST_F(StressTest, SaysWhatIsWrongWithItsOptions) {
    expect_failure(run({"stress", "--watertight", "--self-intersection"}), 2,
                   {"--watertight", "one of them"});
    expect_failure(run({"stress", "--no-skip", "thinking"}), 2, {"--no-skip thinking", "rounding"});
    expect_failure(run({"stress", "--agree", "cpu-double"}), 2, {"--agree cpu-double", "cpu-float"});
    expect_failure(run({"stress", "--agree", "cpu-float", "--device", "cpu-float"}), 2,
                   {"no Vulkan device", "--device"});
    expect_failure(run({"stress", "--self-intersection", "--device", "cpu-double"}), 2, {"cpu-double"});
    expect_failure(run({"stress", "--family", "gentel"}), 2, {"gentel", "gentle"});
    expect_failure(run({"stress", "--pairs", "0"}), 2, {"--pairs 0"});
    for (const char* option : {"--json", "--heat-map"})
        expect_failure(run({"stress", "--pairs", "1e15", option, "no/such/folder/x"}), 5,
                       {"no/such/folder/x"});
}

}  // namespace
}  // namespace strandlab::testing_tools
