// What commands write: files in their documented form, whole or not at all; results on standard output,
// everything else on standard error.
#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace strandlab::testing_tools {
namespace {

using Json = nlohmann::json;

class OutputsTest : public CommandLineTest {
  protected:
    /// Bent hairs of radius 0.02 over a unit square, and a picture's worth of rays onto them.
    void write_bent_hair() const {
        std::vector<Curve> curves;
        for (int i = 0; i < 20; ++i) {
            const float x = 0.05f * static_cast<float>(i), y = 0.013f * static_cast<float>(i * i % 7);
            curves.push_back({glm::vec4(x, y, 0, 0.02f), glm::vec4(x + 0.1f, y + 0.3f, 0.2f, 0.018f),
                              glm::vec4(x - 0.1f, y + 0.6f, -0.2f, 0.014f),
                              glm::vec4(x, y + 0.9f, 0.1f, 0.01f)});
        }
        write_curves(path("c.npy"), curves);
        std::vector<Ray> rays;
        for (int i = 0; i < 3600; ++i)
            rays.push_back(
                ray_at(-0.1f + 0.02f * static_cast<float>(i % 60), 0.017f * static_cast<float>(i / 60)));
        write_rays(path("r.npy"), rays);
    }

    Outcome trace(const Arguments& more = {}) const {
        Arguments arguments{"trace",  "--curves", "c.npy",     "--rays", "r.npy", "--primitive",
                            "rocaps", "--device", "cpu-float", "--out",  "hits"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

TEST_F(OutputsTest, TraceWritesHitsThatAreRight) {
    write_bent_hair();
    const Outcome traced = trace();
    expect_success(traced);
    EXPECT_EQ(traced.output, "");
    EXPECT_EQ(traced.log.rfind("strandlab: hits: 3600 rays through rocaps on cpu-float", 0), 0u)
        << traced.log;
    const auto t = read_npy<float>(ByteSource::from_file(path("hits/t.npy")), {"<f4", {}});
    const auto curve = read_npy<int32_t>(ByteSource::from_file(path("hits/curve.npy")), {"<i4", {}});
    const auto u = read_npy<float>(ByteSource::from_file(path("hits/u.npy")), {"<f4", {}});
    const auto normal = read_npy<glm::vec3>(ByteSource::from_file(path("hits/normal.npy")), {"<f4", {3}});
    ASSERT_EQ(std::vector<size_t>({t.size(), curve.size(), u.size(), normal.size()}),
              std::vector<size_t>(4, 3600));
    size_t hits = 0;
    for (size_t i = 0; i < t.size(); ++i) {
        EXPECT_EQ(std::isfinite(t[i]), curve[i] >= 0);
        if (curve[i] < 0) continue;
        ++hits;
        EXPECT_LT(curve[i], 20);
        EXPECT_TRUE(u[i] >= 0 && u[i] <= 1) << u[i];
        EXPECT_NEAR(glm::length(normal[i]), 1, 1e-5f);
    }
    EXPECT_GT(hits, 1000u);
    const Json stats = Json::parse(read("hits/stats.json"));
    EXPECT_EQ(stats.at("hits").get<size_t>(), hits);
    EXPECT_EQ(stats.at("rays").get<size_t>(), 3600u);
    EXPECT_EQ(stats.at("primitive"), "rocaps");
    EXPECT_EQ(stats.at("caps"), "round");
    EXPECT_EQ(stats.at("trace_ms").size(), 1u);
    for (const char* key : {"parameters", "device", "build_ms", "record_bytes", "leaves"})
        EXPECT_TRUE(stats.contains(key)) << key;

    const Outcome compared = run({"compare", "--curves", "c.npy", "--rays", "r.npy", "--hits", "hits",
                                  "--surface", "sphere", "--caps", "round", "--json"});
    expect_success(compared);
    EXPECT_EQ(compared.log, "");
    EXPECT_EQ(std::count(compared.output.begin(), compared.output.end(), '\n'), 1);
    const Json decisive = Json::parse(compared.output).at("decisive");
    EXPECT_GT(decisive.at("rays").get<size_t>(), 3400u);
    EXPECT_GT(decisive.at("matches").get<size_t>(), 1000u);
    for (const char* error : {"nan", "false_hit", "false_miss", "wrong_strand", "wrong_place"})
        EXPECT_EQ(decisive.at(error).at("count"), 0) << error;
}

TEST_F(OutputsTest, TraceLeavesOutWhatIsNotWanted) {
    write_bent_hair();
    expect_success(trace({"--no-normals", "--repeat", "3"}));
    EXPECT_FALSE(exists("hits/normal.npy"));
    EXPECT_EQ(Json::parse(read("hits/stats.json")).at("trace_ms").size(), 3u);
    const Outcome quiet = trace({"--shadow", "--quiet"});
    expect_success(quiet);
    EXPECT_EQ(quiet.log + quiet.output, "");
}

TEST_F(OutputsTest, ConvertGivesTheSameBytesBack) {
    for (const char* name : {"straight.hair", "curly.hair", "fur.hair"}) {
        const std::string model = std::string(STRANDLAB_MODELS "/") + name;
        const Outcome first = run({"convert", model, "-o", "c.npy", "--write-strands", "s.npy"});
        expect_success(first);
        EXPECT_EQ(first.output, "");
        EXPECT_EQ(first.log.rfind("strandlab: c.npy: ", 0), 0u) << first.log;
        expect_success(run({"convert", "c.npy", "--strands", "s.npy", "-o", "again.hair"}));
        expect_success(
            run({"convert", "c.npy", "--strands", "s.npy", "-o", "c2.npy", "--write-strands", "s2.npy"}));
        EXPECT_EQ(read("c.npy"), read("c2.npy"));
        EXPECT_EQ(read("s.npy"), read("s2.npy"));
        std::filesystem::copy_file(model, path("original"),
                                   std::filesystem::copy_options::overwrite_existing);
        EXPECT_TRUE(read("again.hair") == read("original")) << name;
    }
    write("m.tfx", tfx_file(3));
    write("m.data", data_file({4, 3}));
    for (const char* name : {"m.tfx", "m.data"}) {
        expect_success(run({"convert", name, "-o", "a.hair", "--quiet"}));
        expect_success(run({"convert", "a.hair", "-o", "b.hair", "--quiet"}));
        EXPECT_EQ(read("a.hair"), read("b.hair")) << name;
    }
    expect_last_line(run({"convert", "m.tfx", "-o", "m2.tfx", "--quiet"}), 5, {"m2.tfx", ".hair or .npy"});
}

TEST_F(OutputsTest, KeepsTheOldFileWhereItCannotWrite) {
    write("m.hair", hair_file({3}));
    std::filesystem::create_directory(path("folder.hair"));
    expect_failure(run({"convert", "m.hair", "-o", "nowhere/x.hair"}), 5,
                   {"nowhere/x.hair", "cannot write", "No such file"});
    expect_failure(run({"convert", "m.hair", "-o", "folder.hair"}), 5, {"folder.hair", "cannot write"});
    // A full disk, as far as the program can tell.
    std::filesystem::create_symlink("/dev/full", path("full.hair"));
    expect_failure(run({"convert", "m.hair", "-o", "full.hair"}), 5, {"full.hair", "No space left"});
    std::filesystem::create_symlink("/dev/full", path("full.jsonl"));
    expect_last_line(run({"bench", "m.hair", "--device", "cpu-float", "--primitive", "lss", "--resolution",
                          "8x8", "--json", "full.jsonl"}),
                     5, {"full.jsonl", "No space left"});
    write_bent_hair();
    write("file", "old");
    expect_last_line(run({"trace", "--curves", "c.npy", "--rays", "r.npy", "--primitive", "lss", "--device",
                          "cpu-float", "--out", "file"}),
                     5, {"file"});
    EXPECT_EQ(read("file"), "old");
    EXPECT_EQ(files().size(), 7u);  // what the test made itself, and nothing left behind
}

#ifdef STRANDLAB_IMAGES
TEST_F(OutputsTest, RenderWritesPictures) {
    const std::string model = STRANDLAB_MODELS "/fur.hair";
    const auto render = [&](const std::string& output) {
        return run({"render", model, "-o", output, "--device", "cpu-float", "--resolution", "48x27"});
    };
    for (const char* name : {"x.png", "x.exr"}) {
        const Outcome outcome = render(name);
        expect_success(outcome);
        EXPECT_EQ(outcome.output, "");
        EXPECT_EQ(outcome.log.rfind("strandlab: " + std::string(name) + ": 48 x 27", 0), 0u) << outcome.log;
    }
    EXPECT_EQ(read("x.png").substr(0, 4), "\x89PNG");
    const std::string exr = read("x.exr");
    EXPECT_EQ(exr.substr(0, 4), std::string("\x76\x2f\x31\x01"));
    for (const char* channel : {"depth", "normal", "mask", "strand", "curve"})
        EXPECT_TRUE(contains(exr.substr(0, 4096), channel)) << channel;
    expect_failure(render("x.jpg"), 2, {"x.jpg", ".png"});
    expect_failure(render("nowhere/x.png"), 5, {"nowhere"});
    expect_success(
        run({"render", model, "-o", "x.png", "--device", "cpu-float", "--resolution", "16x9", "--primitive",
             "dots", "--samples", "1", "--no-shadows", "--camera", "from=0,1,1:zoom=4"}));
    EXPECT_EQ(files().size(), 2u);
}
#endif

TEST_F(OutputsTest, ColoursOnlyOnATerminal) {
    const Arguments arguments{"bench", "generate:case,case=arc", "--device", "cpu-float", "--primitive",
                              "lss",   "--resolution",           "8x8",      "--repeat",  "1"};
    const Outcome piped = run(arguments);
    expect_success(piped);
    EXPECT_EQ(piped.log, "");
    EXPECT_TRUE(contains(piped.output, "lss"));
    EXPECT_FALSE(contains(piped.output, "\x1b"));
    const Outcome shown = run_on_terminal(arguments);
    expect_success(shown);
    EXPECT_TRUE(contains(shown.output, "\x1b[1m")) << shown.output;
    const Outcome plain = run_on_terminal(arguments, {{"NO_COLOR", "1"}});
    expect_success(plain);
    EXPECT_TRUE(contains(plain.output, "lss"));
    EXPECT_FALSE(contains(plain.output, "\x1b")) << plain.output;
    // What a file or an option holds moves no cursor.
    EXPECT_FALSE(contains(run({"convert", "\x1b[2Jx\ny.hair", "-o", "z.hair"}).log, "\x1b"));
    expect_failure(run({"convert", "\x1b[2Jx\ny.hair", "-o", "z.hair"}), 5, {"?[2Jx?y.hair"});
}

}  // namespace
}  // namespace strandlab::testing_tools
