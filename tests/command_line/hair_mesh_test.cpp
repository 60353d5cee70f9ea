// Hair meshes on the command line: generate, lod, and as models of other commands.
#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::json;

class HairMeshTest : public CommandLineTest {
  protected:
    static std::string model(const std::string& name) {
        return std::string(STRANDLAB_MODELS "/") + name + ".hairmesh";
    }
};

TEST_F(HairMeshTest, GenerateIsConvertWithItsParametersSpelledOut) {
    const Outcome first =
        run({"generate", model("bob"), "--strands", "50", "--points", "9", "--seed", "3", "--style",
             "curl=0.002", "--style", "clump=0", "-o", "a.npy", "--write-strands", "s.npy"});
    expect_success(first);
    EXPECT_EQ(first.output, "");
    EXPECT_EQ(first.log.rfind("strandlab: a.npy: 50 strands, 400 curves", 0), 0u) << first.log;
    expect_success(run({"convert", model("bob") + ",strands=50,points=9,seed=3,curl=0.002,clump=0", "-o",
                        "b.npy", "--write-strands", "t.npy"}));
    EXPECT_EQ(read("a.npy"), read("b.npy"));
    expect_success(run({"generate", "generate:wavy", "--strands", "5", "-o", "w.hair"}));
}

TEST_F(HairMeshTest, GenerateChoosesTheLevelForADistance) {
    const Outcome far =
        run({"generate", model("fur"), "--strands", "3000", "--distance", "50", "-o", "far.npy"});
    expect_success(far);
    EXPECT_TRUE(contains(far.log, "lod=0.0")) << far.log;
    const Outcome near =
        run({"generate", model("fur"), "--strands", "3000", "--distance", "0.1", "-o", "near.npy"});
    expect_success(near);
    EXPECT_TRUE(contains(near.log, "lod=1 ") && contains(near.log, "3000 strands")) << near.log;
    EXPECT_LT(read("far.npy").size(), read("near.npy").size() / 10);
}

TEST_F(HairMeshTest, GenerateNamesWhatIsWrong) {
    expect_failure(run({"generate", "x.hair", "-o", "a.npy"}), 2, {"x.hair", "FILE.hairmesh"});
    expect_failure(run({"generate", "x.hairmesh", "-o", "a.npy"}), 5, {"x.hairmesh", "No such file"});
    expect_failure(run({"generate", model("bob"), "--style", "curls=1", "-o", "a.npy"}), 2,
                   {"curls", "did you mean"});
    expect_failure(run({"generate", model("bob"), "--strands", "-1", "-o", "a.npy"}), 2, {"strands=-1"});
    write("bad.hairmesh", "strandlab hairmesh 1\nname x\nlayers nan\n");
    expect_failure(run({"generate", "bad.hairmesh", "-o", "a.npy"}), 5,
                   {"bad.hairmesh: line 3", "layers nan"});
    EXPECT_FALSE(exists("a.npy"));
}

TEST_F(HairMeshTest, LodSweepsDistances) {
    const Outcome outcome = run({"lod", model("bob") + ",strands=300,points=9", "--device", "cpu-float",
                                 "--primitive", "lss", "--resolution", "32x32", "--samples", "2", "--repeat",
                                 "1", "--farthest", "4", "--json", "rows.jsonl", "--charts", "."});
    expect_success(outcome);
    EXPECT_TRUE(contains(outcome.output, "lss")) << outcome.output;
    const std::string rows = read("rows.jsonl");
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 3);
    const Json first = Json::parse(rows.substr(0, rows.find('\n')));
    EXPECT_EQ(first.at("distance"), 1);
    EXPECT_EQ(first.at("coverage_bias"), 0);
    EXPECT_EQ(first.at("bytes"), first.at("full_bytes"));
    EXPECT_TRUE(contains(read("lod_bob_lss.svg"), "</svg>"));
    expect_failure(run({"lod", "generate:head"}), 2, {"generate:head", "FILE.hairmesh"});
}

/// One sweep under two names; rows are appended.
TEST_F(HairMeshTest, BenchSweepsThemToo) {
    for (int i = 0; i < 2; ++i)
        expect_success(run({"bench", "--lod", model("fur") + ",strands=300", "--device", "cpu-float",
                            "--primitive", "rocaps", "--resolution", "16x16", "--repeat", "1", "--json",
                            "rows.jsonl", "--images", "."}));
    const std::string rows = read("rows.jsonl");
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 12);
    EXPECT_TRUE(contains(rows, "\"distance\":32.0")) << rows;
    EXPECT_TRUE(contains(read("lod_fur_rocaps.svg"), "</svg>"));
    expect_failure(run({"bench", "--lod"}), 2, {"--lod", "hair mesh"});
    expect_failure(run({"bench", "--lod", "generate:head"}), 2, {"generate:head", "FILE.hairmesh"});
}

TEST_F(HairMeshTest, GenerateOnADeviceWritesTheSameFile) {
    SKIP_WITHOUT_DEVICE();
    const Outcome there = run({"generate", model("wavy"), "--strands", "40", "--points", "9", "--device",
                               "llvmpipe", "-o", "device.npy"});
    expect_success(there);
    EXPECT_TRUE(contains(there.log, "bytes uploaded")) << there.log;
    expect_success(run({"generate", model("wavy"), "--strands", "40", "--points", "9", "-o", "host.npy"}));
    EXPECT_EQ(read("device.npy"), read("host.npy"));
    expect_failure(run({"generate", "generate:head", "--device", "llvmpipe", "-o", "a.npy"}), 2,
                   {"--device llvmpipe", "only hair meshes"});
}

}  // namespace
}  // namespace strandlab::testing_tools
