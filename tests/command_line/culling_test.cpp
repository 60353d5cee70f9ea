// --cull: the rows say what was left out, and never pass for rows of whole scenes.
#include "command_line/sweep.h"

#include <fstream>

namespace strandlab::testing_tools {
namespace {

class CullingTest : public SweepTest {
  protected:
    /// One primitive on one model, from near.
    Arguments bench(const Arguments& more) const {
        Arguments arguments{"bench",        "generate:head,style=straight,strands=400,points=9",
                            "--device",     "cpu-float",
                            "--resolution", "40x24",
                            "--repeat",     "2",
                            "--camera",     "from=1,0.2,0.3:zoom=12",
                            "--primitive",  "prhi",
                            "--no-embree"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
};

TEST_F(CullingTest, RowsSayWhatWasLeftOut) {
    expect_success(run(bench({"--rays", "primary", "--rays", "shadow", "--json", "whole.jsonl"})));
    expect_success(
        run(bench({"--rays", "primary", "--rays", "shadow", "--cull", "reach", "--json", "part.jsonl"})));
    const std::vector<Json> whole = rows("whole.jsonl"), part = rows("part.jsonl");
    ASSERT_EQ(whole.size(), 2u);
    ASSERT_EQ(part.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_TRUE(whole[i]["settings"]["cull"].is_null());
        EXPECT_TRUE(whole[i]["settings"]["left_out_strands"].is_null());
        EXPECT_TRUE(whole[i]["time"]["cull_ms"].is_null());
        EXPECT_EQ(part[i]["settings"]["cull"], "reach");
        const size_t strands = part[i]["settings"]["left_out_strands"];
        EXPECT_GT(strands, 0u);
        EXPECT_LT(strands, 400u);
        EXPECT_EQ(part[i]["settings"]["left_out_curves"], 8 * strands);
        EXPECT_TRUE(part[i]["time"]["cull_ms"].is_number());
        EXPECT_LT(part[i]["memory"]["leaves"], whole[i]["memory"]["leaves"]);
        EXPECT_EQ(part[i]["model"], whole[i]["model"]);
        EXPECT_EQ(part[i]["rays"], whole[i]["rays"]);
        EXPECT_EQ(part[i]["model_error"], whole[i]["model_error"]);
        EXPECT_EQ(part[i]["intersector_error"], whole[i]["intersector_error"]);
        EXPECT_NE(part[i]["key"], whole[i]["key"]);
        EXPECT_NE(part[i]["reproduce"].get<std::string>().find(" --cull reach"), std::string::npos);
        EXPECT_EQ(whole[i]["reproduce"].get<std::string>().find("--cull"), std::string::npos);
    }
}

TEST_F(CullingTest, ARowDoesNotDependOnItsNeighbours) {
    expect_success(
        run(bench({"--rays", "primary", "--rays", "shadow", "--cull", "reach", "--json", "both.jsonl"})));
    expect_success(run(bench({"--rays", "shadow", "--cull", "reach", "--json", "one.jsonl"})));
    EXPECT_EQ(rows("both.jsonl")[1]["settings"], rows("one.jsonl")[0]["settings"]);
    EXPECT_EQ(rows("both.jsonl")[1]["key"], rows("one.jsonl")[0]["key"]);
}

TEST_F(CullingTest, ResumingMixesNothing) {
    expect_success(run(bench({"--rays", "primary", "--json", "rows.jsonl"})));
    for (const char* cull : {"reach", "reach,detail=0.001", "reach"})
        expect_success(run(bench({"--rays", "primary", "--json", "rows.jsonl", "--resume", "--cull", cull})));
    EXPECT_EQ(keys("rows.jsonl").size(), 3u);
    expect_success(
        run(bench({"--rays", "primary", "--json", "off.jsonl", "--cull", "reach", "--no-skip", "reach"})));
    EXPECT_TRUE(rows("off.jsonl")[0]["settings"]["cull"].is_null());
}

TEST_F(CullingTest, MissingDetailIsModelError) {
    expect_success(run(bench({"--rays", "primary", "--cull", "detail=10", "--json", "rows.jsonl"})));
    const Json row = rows("rows.jsonl").at(0);
    EXPECT_EQ(row["settings"]["left_out_strands"], 400);
    EXPECT_EQ(row["model_error"]["all"]["matches"], 0);
    EXPECT_GT(row["model_error"]["all"]["false_miss"]["count"], 0);
    EXPECT_EQ(row["intersector_error"]["all"]["false_miss"]["count"], 0);
}

TEST_F(CullingTest, ExplainAndAblationListIt) {
    const Outcome explained = run(bench({"--rays", "primary", "--cull", "reach", "--explain"}));
    expect_success(explained);
    EXPECT_NE(explained.output.find("out of reach"), std::string::npos) << explained.output;
    EXPECT_NE(explained.output.find("strands that no ray can meet"), std::string::npos);
    const Outcome ablation = run(bench({"--rays", "primary", "--cull", "reach", "--ablation"}));
    expect_success(ablation);
    EXPECT_NE(ablation.output.find("without reach"), std::string::npos) << ablation.output;
}

TEST_F(CullingTest, BadCullingIsRefused) {
    expect_failure(run(bench({"--cull", "detail"})), 2, {"--cull detail", "detail=LENGTH"});
    expect_failure(run(bench({"--cull", "magic"})), 2, {"--cull magic", "reach"});
    expect_failure(run({"trace", "--curves", "generate:fur,strands=10", "--rays", "none.npy", "--primitive",
                        "prhi", "--out", "hits", "--cull", "detail=-1"}),
                   2, {"--cull detail=-1"});
}

TEST_F(CullingTest, TraceGivesTheSameFiles) {
    expect_success(run(bench({"--rays", "primary", "--save-rays", "rays"})));
    std::string rays_file;
    for (const auto& entry : std::filesystem::directory_iterator(path("rays")))
        rays_file = "rays/" + entry.path().filename().string();
    ASSERT_FALSE(rays_file.empty());
    const Arguments trace{"trace",  "--curves", "generate:head,style=straight,strands=400,points=9",
                          "--rays", rays_file,  "--primitive",
                          "rocaps", "--device", "cpu-float"};
    Arguments whole = trace, part = trace;
    whole.insert(whole.end(), {"--out", "whole"});
    part.insert(part.end(), {"--out", "part", "--cull", "reach"});
    expect_success(run(whole));
    expect_success(run(part));
    for (const char* name : {"t.npy", "u.npy", "curve.npy", "normal.npy"})
        EXPECT_EQ(read(std::string("whole/") + name), read(std::string("part/") + name)) << name;
    const Json stats = Json::parse(read("part/stats.json"));
    EXPECT_GT(stats["cull"]["out_of_reach_strands"], 0);
    EXPECT_FALSE(Json::parse(read("whole/stats.json")).contains("cull"));
}

}  // namespace
}  // namespace strandlab::testing_tools
