#include "report/images.h"

#include "base/error.h"
#include "base/random.h"
#include "report/load_images_module.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

/// A folder of its own per test; gone afterwards.
class Images : public testing::Test {
  protected:
    void SetUp() override {
        if (!has_images()) GTEST_SKIP() << "the images module was not built";
    }
    std::string path(const std::string& name) const { return folder_ / name; }
    size_t files() const { return folder_.entries(); }

  private:
    testing_tools::TestFolder folder_;
};

Image sample_image(uint32_t width, uint32_t height) {
    Image image;
    image.width = width;
    image.height = height;
    Random random(1);
    for (float& value : image.add_floats({"R", "G", "B"}))
        value = static_cast<float>(random.range(-0.1, 1.2));
    for (float& value : image.add_floats({"depth.Z"})) value = static_cast<float>(random.range(0, 1e6));
    image.layers.back().floats()[1] = std::numeric_limits<float>::infinity();
    for (float& value : image.add_floats({"normal.X", "normal.Y", "normal.Z"}))
        value = static_cast<float>(random.signed_unit());
    for (uint32_t& value : image.add_integers({"id.curve", "id.strand"})) value = random.bits();
    image.layers.back().integers()[0] = 0xFFFFFFFFu;
    for (uint32_t& value : image.add_integers({"mask"})) value = random.below(2);
    return image;
}

Error error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "no error";
    return {ExitCode::ok, ""};
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST_F(Images, ExrKeepsEveryLayerBitForBit) {
    const Image image = sample_image(37, 21);
    write_image(path("all.exr"), image);
    EXPECT_EQ(files(), 1u);
    const Image read = read_image(path("all.exr"));
    EXPECT_EQ(read.width, image.width);
    EXPECT_EQ(read.height, image.height);
    for (const Layer& layer : image.layers) {
        const Layer* again = read.with_channel(layer.channels[0]);
        ASSERT_NE(again, nullptr) << layer.channels[0];
        EXPECT_EQ(again->channels, layer.channels);
        EXPECT_TRUE(again->values == layer.values) << layer.channels[0];
    }
}

TEST_F(Images, PngIsTheColourAsSrgb) {
    const Image image = sample_image(16, 9);
    write_image(path("preview.PNG"), image);
    const Image read = read_image(path("preview.PNG"));
    ASSERT_EQ(read.layers.size(), 1u);
    EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"R", "G", "B"}));
    const std::vector<float>&stored = read.layers[0].floats(), &linear = image.layers[0].floats();
    ASSERT_EQ(stored.size(), linear.size());
    for (size_t i = 0; i < stored.size(); ++i) EXPECT_EQ(std::lround(stored[i] * 255), to_srgb(linear[i]));
}

TEST_F(Images, WritingReplacesAFileAndIsTheSameEveryTime) {
    const Image image = sample_image(10, 10);
    for (const char* name : {"a.exr", "a.png"}) {
        std::ofstream(path(name)) << "something else";
        write_image(path(name), image);
        const std::string first = bytes_of(path(name));
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // formats know seconds
        write_image(path(name), image);
        EXPECT_TRUE(bytes_of(path(name)) == first) << name;
    }
    EXPECT_EQ(files(), 2u);
}

TEST_F(Images, PathsThatCannotBeWrittenAreNamed) {
    const Image image = sample_image(4, 4);
    const Error ending = error_of([&] { write_image(path("a.jpg"), image); });
    EXPECT_EQ(ending.code, ExitCode::usage);
    EXPECT_NE(std::string(ending.what()).find("a.jpg: the image format '.jpg' is not known"),
              std::string::npos);
    EXPECT_EQ(error_of([&] { write_image(path("none"), image); }).code, ExitCode::usage);

    const Error folder = error_of([&] { write_image(path("no/such/a.png"), image); });
    EXPECT_EQ(folder.code, ExitCode::bad_input);
    EXPECT_NE(std::string(folder.what()).find("there is no folder"), std::string::npos);

    for (const char* name : {"/proc/strandlab.png", "/proc/strandlab.exr"}) {
        const Error error = error_of([&] { write_image(name, image); });
        EXPECT_EQ(error.code, ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    fs::create_directory(path("folder.png"));
    EXPECT_EQ(error_of([&] { write_image(path("folder.png"), image); }).code, ExitCode::bad_input);
    EXPECT_EQ(files(), 1u);
}

TEST_F(Images, ImagesWithoutPixelsOrColourAreRefused) {
    EXPECT_EQ(error_of([&] { write_image(path("a.exr"), Image{}); }).code, ExitCode::usage);
    Image depth;
    depth.width = depth.height = 2;
    depth.add_floats({"depth.Z"});
    EXPECT_EQ(error_of([&] { write_image(path("a.png"), depth); }).code, ExitCode::usage);
    EXPECT_EQ(files(), 0u);
}

/// With the limit on file sizes a write runs out of space half way.
TEST_F(Images, AFullDiskLeavesTheOldFileAndNothingElse) {
    const Image image = sample_image(300, 300);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    for (const char* name : {"a.exr", "a.png"}) {
        std::ofstream(path(name)) << "old";
        rlimit small = before;
        small.rlim_cur = 20000;
        ::setrlimit(RLIMIT_FSIZE, &small);
        const Error error = error_of([&] { write_image(path(name), image); });
        ::setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(error.code, ExitCode::bad_input) << name;
        EXPECT_TRUE(bytes_of(path(name)) == "old") << name;
    }
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(files(), 2u);
}

TEST_F(Images, FilesThatAreNoImagesAreNamed) {
    EXPECT_EQ(error_of([&] { read_image(path("a.exr")); }).code, ExitCode::bad_input);
    write_image(path("good.exr"), sample_image(64, 64));
    write_image(path("good.png"), sample_image(64, 64));
    for (const std::string format : {"exr", "png"}) {
        const std::string good = bytes_of(path("good." + format));
        for (const size_t size : {size_t(0), size_t(5), good.size() / 2}) {
            const std::string name = path("bad." + format);
            std::ofstream(name, std::ios::binary) << good.substr(0, size);
            const Error error = error_of([&] { read_image(name); });
            EXPECT_EQ(error.code, ExitCode::bad_input) << format << size;
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
        }
    }
}

TEST(ImagesWithoutModule, SayWhatIsMissing) {
    if (has_images()) GTEST_SKIP() << "the images module is there";
    const Error error = error_of([] { check_image_path("a.png"); });
    EXPECT_EQ(error.code, ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("a.png: "), std::string::npos);
}

TEST(Srgb, KnownValues) {
    EXPECT_EQ(to_srgb(0), 0);
    EXPECT_EQ(to_srgb(1), 255);
    EXPECT_EQ(to_srgb(0.21404114f), 128);  // half grey (0.5 encoded is 127.5)
    EXPECT_EQ(to_srgb(0.002f), 7);
    EXPECT_EQ(to_srgb(-1), 0);
    EXPECT_EQ(to_srgb(7), 255);
    EXPECT_EQ(to_srgb(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(to_srgb(std::numeric_limits<float>::infinity()), 255);
}

}  // namespace
}  // namespace strandlab
