// Errors of pictures from farther away, of primitives whose errors are known.
#include "report/distant_pictures.h"

#include "strands/models.h"

#include <gtest/gtest.h>

namespace strandlab {
namespace {

class DistantPicturesTest : public testing::Test {
  protected:
    DistantPicturesTest()
        : device_(options()),
          scene_(load_scene("generate:fur,strands=60,seed=3,root_radius=1e-3,tip_radius=5e-4", {})),
          curves_(all_curves(scene_)),
          input_{device_, scene_, curves_, 1, 0, {}} {
        input_.options.normals = true;
        pictures_.emplace(input_, framing(curves_, 1.5), 48, 32, 1, Caps::round);
    }

    static DeviceOptions options() {
        DeviceOptions options;
        options.selector = "cpu-float";
        return options;
    }
    std::vector<DistantError> errors(const std::string& primitive) const {
        return pictures_->errors_of(parse_primitive(primitive));
    }

    TraceDevice device_;
    Scene scene_;
    Curves curves_;
    CaseInput input_;
    std::optional<DistantPictures> pictures_;
};

TEST_F(DistantPicturesTest, AnExactPrimitiveHasNoErrorAtAnyDistance) {
    const std::vector<DistantError> all = errors("rocaps");
    ASSERT_EQ(all.size(), 6u);
    double scale = 1;
    for (const DistantError& error : all) {
        EXPECT_EQ(error.scale, scale);
        EXPECT_NEAR(double(error.rays), 48 * 32 * 8, 48 * 32);  // whole pixels
        EXPECT_GT(error.detail.coverage, 0.01);
        // Rays within a float's precision of a silhouette may differ.
        EXPECT_NEAR(error.detail.coverage_bias, 0, 1e-3) << scale;
        EXPECT_NEAR(error.detail.transmittance_bias, 0, 1e-3) << scale;
        ASSERT_TRUE(error.depth_bias.has_value());
        EXPECT_NEAR(*error.depth_bias, 0, 0.01 * scale) << scale;
        EXPECT_LT(error.flip, 1e-3) << scale;
        scale *= 2;
    }
}

TEST_F(DistantPicturesTest, CrossedStripsCoverTooLittleAndLieTooFarBack) {
    // Two strips across each other are 1 to sqrt(1/2) times as wide as the strand, seen from any side, and
    // pass through its axis.
    for (const DistantError& error : errors("dots")) {
        EXPECT_LT(error.detail.coverage_bias, -0.02) << error.scale;
        EXPECT_GT(error.detail.coverage_bias, -0.3) << error.scale;
        EXPECT_GT(*error.depth_bias, 0.1) << error.scale;
        EXPECT_GT(error.flip, 0.001) << error.scale;
    }
}

TEST_F(DistantPicturesTest, MorePiecesAreNearerToTheCurve) {
    const auto coarse = errors("lss:segments=1"), fine = errors("lss:segments=16");
    EXPECT_LT(4 * fine.front().flip, coarse.front().flip);
    EXPECT_LT(4 * fine.front().detail.coverage_rms, coarse.front().detail.coverage_rms);
    // What is off by less than a pixel is not seen.
    EXPECT_LT(coarse.back().detail.coverage_rms, coarse.front().detail.coverage_rms);
}

}  // namespace
}  // namespace strandlab
