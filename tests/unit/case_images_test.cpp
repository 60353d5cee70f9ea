#include "report/case_images.h"

#include "report/file_name.h"
#include "report/load_images_module.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace strandlab::testing_tools {
namespace {

/// Two straight hairs side by side, and eight rays down onto them.
class CaseImagesTest : public testing::Test {
  protected:
    CaseImagesTest() {
        for (const float x : {0.0f, 1.0f}) {
            Curve curve;
            for (int i = 0; i < 4; ++i) curve[i] = glm::vec4(x, static_cast<float>(i), 0, 0.1f);
            curves_.strands.push_back({static_cast<uint32_t>(curves_.curves.size()), 1});
            curves_.curves.push_back(curve);
        }
        rays_.width = 4;
        rays_.height = 2;
        rays_.rays.resize(8);
        reference_.resize(8);
        hits_.hits.resize(8);
        hits_.normals.resize(8, glm::vec3(0, 0, 1));
        for (size_t i = 0; i < 8; ++i) {
            rays_.rays[i].origin = {0, 1.5f, 1};
            rays_.rays[i].direction = {0, 0, -1};
            if (i == 0 || i == 1) continue;  // the background
            reference_[i] = {.t = 0.9, .u = 0.5, .normal = {0, 0, 1}, .radius = 0.1, .curve = 0};
            hits_.hits[i] = {0.9f, 0.5f, 0, 0};
        }
        hits_.hits[1] = {0.9f, 0.5f, 0, 0};  // false hit
        hits_.hits[3] = {};                  // false miss
        hits_.hits[4].curve = 1;             // other strand
        hits_.hits[5].t = 1.1f;              // other place
        hits_.hits[6].t = 0.93f;             // 0.3 radii
        hits_.hits[7].t = std::numeric_limits<float>::quiet_NaN();
    }

    Curves curves_;
    Rays rays_;
    Hits hits_;
    std::vector<ReferenceHit> reference_;
};

TEST_F(CaseImagesTest, ErrorMapsColourOutcomes) {
    const Image map = error_map(
        {.rays = rays_.rays, .hits = hits_.hits, .reference = reference_, .curves = &curves_}, 4, 2);
    const std::vector<float>& pixels = map.with_channel("R")->floats();
    const auto pixel = [&](size_t i) {
        return glm::vec3(pixels[3 * i], pixels[3 * i + 1], pixels[3 * i + 2]);
    };
    const auto is_grey = [&](size_t i) { return pixel(i).x == pixel(i).y && pixel(i).y == pixel(i).z; };
    EXPECT_LT(pixel(0).x, 0.01f);
    EXPECT_TRUE(is_grey(0) && is_grey(2) && is_grey(6));
    EXPECT_GT(pixel(1).x, pixel(1).z);  // red
    EXPECT_GT(pixel(3).z, pixel(3).x);  // blue
    EXPECT_FALSE(is_grey(4));
    EXPECT_FALSE(is_grey(5));
    EXPECT_NE(pixel(4), pixel(5));
    EXPECT_GT(pixel(6).x, pixel(2).x + 0.2f);  // farther off is lighter
    EXPECT_EQ(pixel(7), glm::vec3(1));
}

TEST_F(CaseImagesTest, ReferencesBecomeHits) {
    const Hits hits = hits_of(reference_);
    EXPECT_FALSE(hits.hits[0].is_hit());
    EXPECT_EQ(hits.hits[2].t, 0.9f);
    EXPECT_EQ(hits.hits[2].curve, 0u);
    EXPECT_EQ(hits.normals[2], glm::vec3(0, 0, 1));
}

TEST_F(CaseImagesTest, WritesThreePictures) {
    if (!has_images()) GTEST_SKIP() << "the images module was not built";
    const TestFolder folder;
    CasePicture picture{folder / ".", "two_hairs", "lss_segments=8", 4, 2, rays_, hits_, curves_, reference_};
    const CaseImages images = write_case_images(picture);
    for (const std::string& path : {images.rendered, images.reference, images.error_map}) {
        const Image image = read_image(path);
        EXPECT_EQ(image.width, 4u) << path;
        EXPECT_EQ(image.height, 2u);
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "two_hairs_lss_segments=8_errors.png"));
    picture.reference = {};
    EXPECT_EQ(write_case_images(picture).error_map, "");
}

TEST(FileName, IsOneAnywhere) {
    EXPECT_EQ(file_name_of("curly"), "curly");
    EXPECT_EQ(file_name_of("../a b/\nc:d=1,e"), "a_b_c_d=1_e");
    EXPECT_EQ(file_name_of("..."), "unnamed");
    EXPECT_EQ(file_name_of(std::string(500, 'x')).size(), 60u);
    const std::vector<std::string> texts{
        "a", "a b", "a-2", "a/b", "a", "a", std::string(70, 'x'), std::string(71, 'x')};
    EXPECT_EQ(file_names_of(texts),
              (std::vector<std::string>{"a", "a_b", "a-2", "a_b-2", "a-3", "a-4", std::string(60, 'x'),
                                        std::string(60, 'x') + "-2"}));
}

}  // namespace
}  // namespace strandlab::testing_tools
