// Sweeps of bench: lists, limits, presets, and the files that they write.
#include "command_line/sweep.h"

#include <algorithm>

namespace strandlab::testing_tools {
namespace {

TEST_F(SweepTest, RunsEveryCombination) {
    Arguments arguments = sweep({"--json", "r.jsonl"});
    std::replace(arguments.begin(), arguments.end(), std::string("40x24"), std::string("40x24,20x12"));
    expect_success(run(arguments));
    const std::vector<Json> all = rows("r.jsonl");
    ASSERT_EQ(all.size(), 2 * cases);
    std::set<size_t> numbers;
    for (const Json& row : all) {
        const Json& axes = row.at("sweep");
        EXPECT_EQ(axes.at("cases"), 2 * cases);
        EXPECT_EQ(axes.at("primitives"),
                  Json({"lss:segments=1", "lss:segments=2", "prhi:splits=1", "prhi:splits=2"}));
        EXPECT_EQ(axes.at("resolutions"), Json({"40x24", "20x12"}));
        const size_t number = axes.at("case");
        numbers.insert(number);
        EXPECT_EQ(axes.at("primitives").at(number % 4), row.at("primitive").at("label"));
        EXPECT_EQ(axes.at("rays").at(number / 4 % 2), row.at("rays").at("name"));
        EXPECT_EQ(axes.at("resolutions").at(number / 8 % 2), row.at("rays").at("resolution"));
        EXPECT_EQ(axes.at("models").at(number / 16), row.at("model").at("name"));
        EXPECT_EQ(row.at("time").at("samples_ms").size(), 2u);
        EXPECT_EQ(row.at("time").at("wall_samples_ms").size(), 2u);
        EXPECT_EQ(row.at("time").at("ratio").at("baseline"), "lss:segments=1");
    }
    EXPECT_EQ(numbers.size(), 2 * cases);
    // Samples of one model and ray set alternate: in each round every place is taken once.
    for (size_t round = 0; round < 2; ++round) {
        std::set<size_t> places;
        for (const Json& row : all)
            if (row.at("sweep").at("case") < 4)
                places.insert(size_t(row.at("time").at("positions").at(round)));
        EXPECT_EQ(places.size(), 4u);
    }
}

TEST_F(SweepTest, EveryRowNamesTheCommandThatMakesItAgain) {
    write_curves(path("it's.npy"),
                 {line_curve({0, 0, 0}, {0, 1, 0}, 0.1f), line_curve({1, 0, 0}, {1, 1, 0}, 0.1f)});
    expect_success(run({"bench",           "it's.npy",       "--device",    "cpu-float",
                        "--resolution",    "16x9",           "--rays",      "diffuse:shuffled",
                        "--rays",          "primary:shadow", "--primitive", "rocaps:splits=1,2",
                        "--caps",          "open",           "--repeat",    "1",
                        "--json",          "a.jsonl",        "--seed",      "5",
                        "--no-compaction", "--no-embree"}));
    for (const Json& row : rows("a.jsonl")) {
        const std::string command = row.at("reproduce");
        EXPECT_EQ(command.rfind("strandlab bench ", 0), 0u);
        const std::string shell = "cd '" + path("") + "' && XDG_CACHE_HOME=cache '" STRANDLAB_PROGRAM "' " +
                                  command.substr(std::string("strandlab ").size()) +
                                  " --json again.jsonl --quiet > /dev/null";
        ASSERT_EQ(std::system(shell.c_str()), 0) << shell;
        bool found = false;
        for (Json again : rows("again.jsonl"))
            found |= again.at("key") == row.at("key") && again.at("model_error") == row.at("model_error");
        EXPECT_TRUE(found) << command;
    }
}

TEST_F(SweepTest, MakesEveryKindOfRaysOnce) {
    Arguments arguments{"bench",        "generate:fur,strands=200",
                        "--device",     "cpu-float",
                        "--resolution", "48x32",
                        "--repeat",     "1",
                        "--json",       "r.jsonl",
                        "--primitive",  "lss",
                        "--primitive",  "rocaps",
                        "--no-embree"};
    for (const char* set : {"primary", "primary:shuffled", "primary:shadow", "shadow", "diffuse", "ambient",
                            "grazing", "interior"})
        arguments.insert(arguments.end(), {"--rays", set});
    expect_success(run(arguments));
    std::map<std::string, std::set<std::string>> hashes;
    for (const Json& row : rows("r.jsonl")) {
        const Json& rays = row.at("rays");
        hashes[rays.at("name")].insert(rays.at("hash").get<std::string>());
        EXPECT_EQ(rays.at("seed"), 1);
        EXPECT_EQ(rays.at("shuffled"), rays.at("name") == "primary shuffled");
        const bool hit_or_miss = rays.at("name") == "shadow" || rays.at("name") == "ambient" ||
                                 rays.at("name") == "primary shadow";
        EXPECT_EQ(row.at("model_error").at("hit_or_miss_only"), hit_or_miss);
        // Round hair by exact intersectors: nothing decisive is wrong.
        if (row.at("primitive").at("name") == "rocaps") {
            EXPECT_EQ(row.at("model_error").at("decisive").at("false_hit").at("count"), 0) << rays;
            EXPECT_EQ(row.at("model_error").at("decisive").at("false_miss").at("count"), 0) << rays;
        }
    }
    EXPECT_EQ(hashes.size(), 8u);
    EXPECT_EQ(hashes.at("primary"), hashes.at("primary shadow"));
    for (const auto& [name, all] : hashes) EXPECT_EQ(all.size(), 1u) << name;  // the same for both primitives
}

TEST_F(SweepTest, LeavesOutWhatIsBeyondItsLimits) {
    const Arguments base{"bench",        "generate:fur,strands=60",
                         "--device",     "cpu-float",
                         "--resolution", "96x64",
                         "--repeat",     "1",
                         "--rays",       "interior",
                         "--primitive",  "lss:segments=1,64",
                         "--no-embree"};
    const auto with = [&](Arguments more) {
        more.insert(more.begin(), base.begin(), base.end());
        return run(more);
    };
    expect_success(with({"--json", "all"}));
    ASSERT_EQ(rows("all").size(), 2u);
    const Outcome errors = with({"--json", "error", "--max-error", "0.1"});
    expect_success(errors);
    ASSERT_EQ(rows("error").size(), 1u);
    EXPECT_EQ(rows("error").at(0).at("primitive").at("label"), "lss:segments=64");
    EXPECT_TRUE(contains(errors.log, "lss:segments=1 is left out, beyond --max-error")) << errors.log;
    const size_t most = rows("all").at(0).at("memory").at("resident_bytes");
    expect_success(with({"--json", "memory", "--max-memory", std::to_string(most)}));
    ASSERT_EQ(rows("memory").size(), 1u);
    EXPECT_EQ(rows("memory").at(0).at("primitive").at("label"), "lss:segments=1");
    const Outcome time = with({"--json", "time", "--time-budget", "1e-9"});
    expect_success(time);
    EXPECT_FALSE(exists("time"));
    EXPECT_TRUE(contains(time.log, "--resume")) << time.log;
    expect_failure(with({"--max-error", "-1"}), 2, {"--max-error"});
    expect_failure(with({"--max-error", "1", "--error-rays", "0"}), 2, {"--max-error 1", "--error-rays"});
}

TEST_F(SweepTest, OnePrimitiveAtATimeGivesTheSameRows) {
    expect_success(run(sweep({"--json", "together"})));
    expect_success(
        run(sweep({"--json", "apart", "--interleave", "1", "--baseline-primitive", "prhi:splits=2"})));
    EXPECT_EQ(keys("together"), keys("apart"));
    for (const Json& row : rows("apart")) {
        EXPECT_EQ(row.at("time").at("ratio").at("baseline"), "prhi:splits=2");
        EXPECT_EQ(row.at("time").at("ratio").at("samples").size(), 2u);
    }
    expect_failure(run(sweep({"--baseline-primitive", "dots"})), 2,
                   {"--baseline-primitive dots", "--primitive"});
}

TEST_F(SweepTest, MeasuresNothingTwice) {
    Arguments arguments = sweep({"--json", "r.jsonl", "--rays", "primary", "--primitive", "lss:segments=2"});
    arguments.insert(arguments.begin() + 1, "generate:fur,strands=60");
    expect_success(run(arguments));
    EXPECT_EQ(keys("r.jsonl").size(), cases);
}

#ifdef STRANDLAB_IMAGES
TEST_F(SweepTest, WritesThePicturesThatItsRowsName) {
    expect_success(run(sweep({"--json", "r.jsonl", "--images", "pictures"})));
    size_t named = 0;
    for (const Json& row : rows("r.jsonl")) {
        EXPECT_EQ(row.at("images").is_null(), row.at("rays").at("name") != "primary");
        EXPECT_EQ(row.at("distances").is_null(), row.at("images").is_null());
        if (row.at("images").is_null()) continue;
        for (const char* kind : {"rendered", "reference", "error_map"}) {
            EXPECT_TRUE(exists(row.at("images").at(kind))) << row.at("images");
            ++named;
        }
        ASSERT_EQ(row.at("distances").size(), 6u);
        EXPECT_EQ(row.at("distances").at(5).at("scale"), 32);
        for (const Json& error : row.at("distances")) EXPECT_LT(error.at("flip"), 0.5) << error;
    }
    EXPECT_EQ(named, 3 * cases / 2);
}
#endif

TEST_F(SweepTest, SavesTheRaysOfEveryModelAndResolutionApart) {
    // Two models of one name, two files of rays of one name, two resolutions.
    for (const char* folder : {"a", "b"}) {
        std::filesystem::create_directory(path(folder));
        const float at = folder[0] == 'a' ? 0.0f : 0.5f;
        write_curves(path(std::string(folder) + "/m.npy"), {line_curve({at, 0, 0}, {at, 1, 0}, 0.1f)});
        write_rays(path(std::string(folder) + "/r.npy"), {{{at, 0.5f, 2}, 0, {0, 0, -1}, 1e30f}});
    }
    expect_success(run({"bench",       "a/m.npy",  "b/m.npy", "--device",    "cpu-float", "--rays",
                        "primary",     "--rays",   "a/r.npy", "--rays",      "b/r.npy",   "--resolution",
                        "8x6,4x2",     "--repeat", "1",       "--primitive", "lss",       "--no-embree",
                        "--save-rays", "rays",     "--json",  "r.jsonl"}));
    std::map<std::string, size_t> bytes;
    for (const auto& entry : std::filesystem::directory_iterator(path("rays")))
        bytes[entry.path().filename().string()] = entry.file_size();
    EXPECT_EQ(bytes.size(), 12u);
    for (const char* model : {"m", "m-2"}) {
        EXPECT_EQ(bytes[model + std::string(".8x6.primary.npy")], 128u + 48 * 32) << model;
        EXPECT_EQ(bytes[model + std::string(".4x2.primary.npy")], 128u + 8 * 32) << model;
        EXPECT_EQ(bytes[model + std::string(".8x6.r-2.npy")], 128u + 32) << model;
    }
    EXPECT_NE(read("rays/m.8x6.primary.npy"), read("rays/m-2.8x6.primary.npy"));
    EXPECT_EQ(read("rays/m.8x6.r.npy"), read("a/r.npy"));
    EXPECT_EQ(read("rays/m.8x6.r-2.npy"), read("b/r.npy"));
    EXPECT_EQ(read("rays/m-2.4x2.r-2.npy"), read("b/r.npy"));
}

TEST_F(SweepTest, EveryPresetHasItsModels) {
    for (const char* preset : {"quick", "default", "full"}) {
        const Outcome outcome = run({"bench", "--preset", preset, "--device", "cpu-float", "--resolution",
                                     "8x8", "--error-rays", "0", "--repeat", "1", "--rays", "primary",
                                     "--no-embree", "--primitive", "lss:segments=1", "--json", preset});
        expect_success(outcome);
        EXPECT_EQ(rows(preset).size(), std::string(preset) == "quick" ? 1u : 7u) << outcome.output;
    }
}

TEST_F(SweepTest, RebuildsThePublishedTableAtTheSizeThatTheDeviceTakes) {
    const Outcome outcome =
        run({"bench", "--preset", "article", "--device", "cpu-float", "--error-rays", "0", "--repeat", "1",
             "--resolution", "8x8", "--primitive", "lss:segments=1", "--no-embree", "--json", "r.jsonl"});
    expect_success(outcome);
    for (const char* text : {"11,836,704 curves are too many for cpu-float; scaled down to 197,184",
                             "1,656,005 curves are too many for cpu-float; scaled down to 183,950"})
        EXPECT_TRUE(contains(outcome.log, text)) << outcome.log;
    const std::vector<Json> all = rows("r.jsonl");
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.at(0).at("model").at("curves"), 197'184);
    EXPECT_EQ(all.at(1).at("model").at("curves"), 183'950);
    // One line of the table for each, with the memory of the buffers: 40 bytes a curve here.
    EXPECT_TRUE(contains(outcome.output, "197,184  lss:segments=1")) << outcome.output;
    EXPECT_EQ(all.at(0).at("memory").at("buffer_bytes"), 197'184 * 40);
}

}  // namespace
}  // namespace strandlab::testing_tools
