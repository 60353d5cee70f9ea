// Which primitives are on the device together.
#include "measure/scene_group.h"

#include "strands/generators.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strandlab {
namespace {

/// A few strands on the processor, and four primitives that take ever more memory.
struct GroupCase {
    TraceDevice device{{"cpu-float", false}};
    Scene scene = scene_of("few", generate("generate:fur,strands=20"));
    Curves curves = all_curves(scene);
    CaseInput input{device, scene, curves};
    std::vector<PrimitiveChoice> choices;

    GroupCase() {
        for (const char* text : {"lss:segments=1", "lss:segments=2", "lss:segments=8", "lss:segments=16"})
            choices.push_back(parse_primitive(text));
    }

    /// The labels of every group.
    std::vector<std::vector<std::string>> groups(size_t baseline, std::vector<size_t> waiting,
                                                 const GroupLimits& limits) const {
        SceneGroups all(input, choices, baseline, std::move(waiting), limits);
        std::vector<std::vector<std::string>> labels;
        for (auto group = all.next(); !group.empty(); group = all.next()) {
            labels.emplace_back();
            for (const PreparedCase* prepared : group) {
                EXPECT_NE(prepared->traced, nullptr);
                labels.back().push_back(prepared->choice.label());
            }
            EXPECT_NE(all.baseline(), nullptr);
            EXPECT_EQ(all.baseline()->choice.label(), choices[baseline].label());
        }
        return labels;
    }
};

using Groups = std::vector<std::vector<std::string>>;

TEST(SceneGroups, HoldEverythingWhereItFits) {
    const GroupCase some;
    EXPECT_EQ(some.groups(0, {0, 1, 2, 3}, {}),
              (Groups{{"lss:segments=1", "lss:segments=2", "lss:segments=8", "lss:segments=16"}}));
    EXPECT_EQ(some.groups(3, {1, 2}, {uint64_t(1) << 40, 0}), (Groups{{"lss:segments=2", "lss:segments=8"}}));
    EXPECT_EQ(some.groups(0, {}, {}), Groups{});
}

TEST(SceneGroups, HoldAsManyAsWanted) {
    const GroupCase some;
    EXPECT_EQ(some.groups(0, {0, 1, 2, 3}, {0, 3}),
              (Groups{{"lss:segments=1", "lss:segments=2", "lss:segments=8"}, {"lss:segments=16"}}));
    EXPECT_EQ(some.groups(2, {0, 1, 2, 3}, {0, 1}),
              (Groups{{"lss:segments=1"}, {"lss:segments=2"}, {"lss:segments=8"}, {"lss:segments=16"}}));
}

TEST(SceneGroups, HoldWhatFitsTogether) {
    const GroupCase some;
    // The largest fits beside the baseline only; a limit below any still tries one at a time.
    const uint64_t largest = make_geometry(some.scene, some.choices[3]).device_bytes();
    EXPECT_EQ(some.groups(0, {0, 1, 2, 3}, {largest, 0}),
              (Groups{{"lss:segments=1", "lss:segments=2", "lss:segments=8"}, {"lss:segments=16"}}));
    EXPECT_EQ(some.groups(0, {0, 1, 2, 3}, {1, 0}),
              (Groups{{"lss:segments=1", "lss:segments=2"}, {"lss:segments=8"}, {"lss:segments=16"}}));
    EXPECT_GT(group_limits(some.device.info(), 0).bytes, 0u);
}

}  // namespace
}  // namespace strandlab
