// With Vulkan, without it, and with its validation layers.
#include "command_line/files.h"
#include "command_line/program.h"

namespace strandlab::testing_tools {
namespace {

const std::string fur = STRANDLAB_MODELS "/fur.hair";

/// The bundled models of this source tree.
const Environment bundled{{"STRANDLAB_MODELS", STRANDLAB_MODELS}};

Environment without_vulkan() {
    Environment all = no_vulkan;
    all.insert(all.end(), bundled.begin(), bundled.end());
    return all;
}

class DevicesTest : public CommandLineTest {
  protected:
    void SetUp() override {
        write_curves(path("c.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, 0.1f)});
        write_rays(path("r.npy"), {ray_at(0), ray_at(0.5f)});
    }

    /// One run of every command that traces; bench and validate take the bundled models.
    static std::vector<Arguments> tracing_commands(const Arguments& more) {
        std::vector<Arguments> all{
            {"bench", "--resolution", "32x18", "--repeat", "1"},
            {"validate", "--resolution", "32x18"},
            {"trace", "--curves", "c.npy", "--rays", "r.npy", "--primitive", "lss", "--out", "hits"},
#ifdef STRANDLAB_IMAGES
            {"render", fur, "-o", "x.png", "--resolution", "32x18"},
#endif
        };
        for (Arguments& arguments : all) arguments.insert(arguments.end(), more.begin(), more.end());
        return all;
    }
};

TEST_F(DevicesTest, WithoutVulkanSaysWhatToInstall) {
    for (const Arguments& arguments : tracing_commands({})) {
        const Outcome outcome = run(arguments, without_vulkan());
        if (outcome.code == 0) GTEST_SKIP() << "this Vulkan loader finds drivers elsewhere";
        expect_failure(outcome, 3, {"tools/setup", "lavapipe"});
    }
    const Outcome info = run({"info"}, no_vulkan);
    EXPECT_EQ(info.code, 3);
    EXPECT_TRUE(contains(info.output, "device: none (")) << info.output;
    EXPECT_TRUE(contains(info.output, "tools/setup")) << info.output;
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(DevicesTest, TheProcessorNeedsNoVulkan) {
    for (const char* device : {"cpu-float", "cpu-double"})
        for (const Arguments& arguments : tracing_commands({"--device", device}))
            expect_success(run(arguments, without_vulkan()));
    expect_failure(run({"bench", fur, "--device", "cpu-float", "--validation"}), 2,
                   {"--validation", "cpu-float"});
}

TEST_F(DevicesTest, NamesTheDevicesThereAre) {
    SKIP_WITHOUT_DEVICE();
    expect_failure(run({"bench", fur, "--device", "abacus"}), 3, {"--device abacus", "there are"});
    expect_failure(run({"bench", fur, "--device", "99"}), 3, {"--device 99", "there are"});
    const Outcome info = run({"info"});
    expect_success(info);
    EXPECT_EQ(info.log, "");
    for (const char* primitive : {"dots", "lss", "prhi", "rocaps"})
        EXPECT_TRUE(contains(info.output, primitive)) << info.output;
}

TEST_F(DevicesTest, ValidationLayersAreSilent) {
    SKIP_WITHOUT_DEVICE();
    for (const Arguments& arguments : tracing_commands({"--validation"})) {
        const Outcome outcome = run(arguments, bundled);
        if (contains(outcome.log, "is not installed")) GTEST_SKIP() << outcome.log;
        expect_success(outcome);
        EXPECT_FALSE(contains(outcome.log + outcome.output, "VUID")) << outcome.log << outcome.output;
    }
}

}  // namespace
}  // namespace strandlab::testing_tools
