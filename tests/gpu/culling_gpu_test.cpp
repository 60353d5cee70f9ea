// On a Vulkan device answers have the same bits without the strands that are out of reach.
#include "../unit/support/culled_scenes.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <optional>

namespace strandlab {
namespace {

class CullingGpuTest : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        try {
            device_.emplace(DeviceOptions{});
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
    std::optional<TraceDevice> device_;
};

TEST_P(CullingGpuTest, AnswersStayTheSame) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    const Scene moved = testing::moved_scene();
    testing::expect_same_answers(*device_, moved, testing::partial_rays(moved, 3000, 0.1f), choice);
    const Scene plain = scene_of("head", generate("generate:head,style=curly,strands=300,points=20"));
    testing::expect_same_answers(*device_, plain, testing::partial_rays(plain, 3000, 0.1f), choice);
}

TEST_P(CullingGpuTest, ModelsWithoutStrandsAreNoObstacle) {
    const PrimitiveChoice choice = parse_primitive(GetParam());
    const Scene scene = testing::moved_scene();
    Scene second = scene;
    second.instances = {scene.instances[3]};  // rays at this one alone
    testing::expect_same_answers(*device_, scene, testing::partial_rays(second, 500, 0.1f), choice);
}

INSTANTIATE_TEST_SUITE_P(Primitives, CullingGpuTest,
                         ::testing::Values("dots", "lss", "lss:tolerance=0.3", "prhi", "rocaps"),
                         testing::name_of_choice);

}  // namespace
}  // namespace strandlab
