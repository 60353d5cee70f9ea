#include "strands/generators.h"

#include "base/parallel.h"
#include "strands/bezier.h"
#include "strands/models.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace strandlab {
namespace {

using testing_tools::message_of;

std::string usage_of(const std::string& spec) {
    return message_of([&] { generate(spec); }, ExitCode::usage);
}

TEST(Generators, EveryOneKeepsTheInvariants) {
    for (const Generator& generator : generators()) {
        const bool has_strands = generator.name != "case";
        const Curves curves = generate("generate:" + generator.name + (has_strands ? ",strands=60" : ""));
        ASSERT_FALSE(curves.curves.empty());
        uint32_t next = 0;
        for (const StrandRange& strand : curves.strands) {
            EXPECT_EQ(strand.first, next);
            next += strand.count;
            for (uint32_t c = strand.first + 1; c < next; ++c)
                EXPECT_EQ(curves.curves[c - 1][3], curves.curves[c][0]);
        }
        EXPECT_EQ(next, curves.curves.size());
        for (const Curve& curve : curves.curves)
            for (const glm::vec4& p : curve) EXPECT_TRUE(is_usable(p) && p.w >= 0);
    }
}

TEST(Generators, GiveTheSameBitsForAnyNumberOfThreads) {
    for (const char* spec :
         {"generate:head,strands=500,style=curly", "generate:fur,strands=3000", "generate:helix"}) {
        const uint64_t all = hash(generate(spec));
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(hash(generate(spec)), all);
    }
}

TEST(Generators, GiveTheBitsOfEveryOtherMachine) {
    const std::pair<const char*, uint64_t> golden[] = {
        {"generate:straight,strands=100", 0xd33f2f1ff720bb26u},
        {"generate:wavy,strands=100", 0x962e33b526a1a9feu},
        {"generate:helix,strands=100", 0x4f69112f7a0ca2ccu},
        {"generate:head,strands=100", 0xed5be88f1c083293u},
        {"generate:head,strands=100,style=wavy", 0xe757b79afdaff7cfu},
        {"generate:head,strands=100,style=curly,seed=9", 0x7e38b9ac49b1a0cbu},
        {"generate:fur,strands=300", 0x28132941f39a7b30u},
        {"generate:case", 0x43f862fca9bf515fu},
    };
    for (const auto& [spec, expected] : golden)
        EXPECT_EQ(hash(generate(spec)), expected) << spec << std::hex << " " << hash(generate(spec));
}

TEST(Generators, SeedsAndSizesMatter) {
    EXPECT_NE(hash(generate("generate:wavy,strands=5,seed=2")),
              hash(generate("generate:wavy,strands=5,seed=3")));
    const Curves curves = generate(
        "generate:straight,strands=7,points=5,length=2,length_variation=0,root_radius=0.25,tip_radius=0.125");
    EXPECT_EQ(curves.strands.size(), 7u);
    EXPECT_EQ(curves.curves.size(), 28u);
    for (const StrandRange& strand : curves.strands) {
        const glm::vec4 root = curves.curves[strand.first][0], tip = curves.curves[strand.first + 3][3];
        EXPECT_NEAR(glm::length(glm::dvec3(tip - root)), 2, 1e-6);
        EXPECT_EQ(root.w, 0.25f);
        EXPECT_EQ(tip.w, 0.125f);
        EXPECT_EQ(root.y, 0);
    }
}

TEST(Generators, HeadsHaveRootsOnTheScalpAndHairOutsideTheHead) {
    const glm::dvec3 axes(0.078, 0.105, 0.095);
    const Curves curves = generate("generate:head,strands=400,style=straight,gathering=0");
    for (const StrandRange& strand : curves.strands) {
        EXPECT_NEAR(glm::length(glm::dvec3(curves.curves[strand.first][0]) / axes), 1, 1e-5);
        for (uint32_t c = strand.first; c < strand.first + strand.count; ++c)
            EXPECT_GT(glm::length(glm::dvec3(curves.curves[c][3]) / axes), 0.99999);
    }
}

TEST(Generators, CasesAreWhatTheirNamesSay) {
    const auto only = [](const std::string& name) {
        return to_double(generate("generate:case,case=" + name).curves.at(0));
    };
    EXPECT_EQ(glm::dvec3(derivative_at(only("cusp"), 0.5)), glm::dvec3(0));
    EXPECT_EQ(only("point")[0], only("point")[3]);
    EXPECT_EQ(only("closed")[0], only("closed")[3]);
    EXPECT_EQ(only("repeated_start")[0], only("repeated_start")[1]);
    EXPECT_EQ(only("repeated_end")[2], only("repeated_end")[3]);
    EXPECT_EQ(only("zero_tip")[3].w, 0);
    EXPECT_LT(derivative_at(only("fold_back"), 0.5).x, 0);
    EXPECT_GT(turning_bound(only("hairpin")), 3.1);
    const CurveD bend = only("thick_bend");  // radius above the radius of curvature |C'|^3 / |C' x C''|
    const glm::dvec3 d(derivative_at(bend, 0.5)), dd(second_derivative_at(bend, 0.5));
    EXPECT_GT(bend[0].w, std::pow(glm::length(d), 3) / glm::length(glm::cross(d, dd)));
    const CurveD taper = only("hard_taper");  // the radius falls faster than the curve advances
    EXPECT_GT(-derivative_at(taper, 0.5).w, derivative_at(taper, 0.5).x);
    const CurveD tiny = to_double(generate("generate:case,case=arc,size=1e-6").curves[0]);
    EXPECT_NEAR(tiny[3].x, 1e-6, 1e-12);
    EXPECT_NEAR(tiny[0].w, 5e-8, 1e-14);
}

TEST(Generators, NameWhatIsWrong) {
    EXPECT_NE(usage_of("generate:wawy").find("generate:wawy: no such generator, did you mean 'wavy'?"),
              std::string::npos);
    EXPECT_NE(usage_of("generate:").find("no such generator"), std::string::npos);
    EXPECT_NE(usage_of("generate:wavy,strand=3")
                  .find("generate:wavy: no parameter 'strand', did you mean 'strands'?"),
              std::string::npos);
    EXPECT_NE(usage_of("generate:wavy,strands=0").find("strands=0 is not a whole number from 1 to 1e+08"),
              std::string::npos);
    EXPECT_NE(usage_of("generate:wavy,length=nan").find("length=nan"), std::string::npos);
    EXPECT_NE(usage_of("generate:head,style=bob").find("style=bob is not straight, wavy or curly"),
              std::string::npos);
    EXPECT_NE(usage_of("generate:wavy,strands").find("'strands' is not key=value"), std::string::npos);
    EXPECT_NE(usage_of("generate:fur,strands=1e8,points=100").find("10000000000, above 2^32 - 1"),
              std::string::npos);
}

}  // namespace
}  // namespace strandlab
