// Hair meshes in and out: the same bytes again, and one clear line for every kind of damage.
#include "base/file.h"
#include "base/random.h"
#include "fuzz/load_hair_mesh_bytes.h"
#include "fuzz/samples.h"
#include "strands/models.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace strandlab {
namespace {

using testing_tools::contains;
using testing_tools::message_of;

HairMesh read_text(const std::string& text) {
    return read_hair_mesh(ByteSource::from_memory("m.hairmesh", samples::as_bytes(text)));
}

/// The first sample with one part replaced.
std::string sample_with(const std::string& part, const std::string& instead, size_t which = 0) {
    std::string text = samples::hair_meshes()[which];
    const size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), instead);
}

TEST(HairMeshFile, GivesTheSameBytesAgain) {
    for (const std::string& text : samples::hair_meshes()) EXPECT_EQ(to_text(read_text(text)), text);
    size_t models = 0;
    for (const auto& entry : std::filesystem::directory_iterator(STRANDLAB_MODELS)) {
        if (entry.path().extension() != ".hairmesh") continue;
        ++models;
        const std::string path = entry.path().string();
        EXPECT_TRUE(to_text(read_hair_mesh(ByteSource::from_file(path))) == read_file(path)) << path;
    }
    EXPECT_EQ(models, 7u);
}

TEST(HairMeshFile, HoldsWhatItSays) {
    const HairMesh mesh = read_text(samples::hair_meshes()[0]);
    EXPECT_EQ(mesh.name, "patch");
    EXPECT_EQ(mesh.comments, (std::vector<std::string>{"# A patch.", "# Two lines."}));
    EXPECT_EQ(mesh.unit(), 0.001);
    EXPECT_EQ(mesh.faces.size(), 1u);
    EXPECT_EQ(mesh.positions[mesh.index(1, 2)], glm::dvec3(22, 30, -20));
    EXPECT_EQ(mesh.style.number("curl"), 0.002);
    EXPECT_EQ(mesh.frames, FrameRule::root);
    EXPECT_EQ(read_text(samples::hair_meshes()[1]).frames, FrameRule::layer);
    EXPECT_EQ(read_text(samples::hair_meshes()[2]).w[5], 31);
}

TEST(HairMeshFile, TakesBlanksCommentsAndCarriageReturns) {
    std::string text = sample_with("uv\n0 0\n", "\n  # remark\nuv # of all\r\n\t0   0 # here\r\n");
    EXPECT_EQ(read_text(text).uv[0], glm::dvec2(0));
}

TEST(HairMeshFile, NamesFileLineAndReasonOfEveryDamage) {
    const std::string valid = samples::hair_meshes()[0];
    struct Damage {
        std::string text, line, reason;
    };
    const Damage damages[] = {
        {"", "line 1", "no hair mesh"},
        {sample_with("strandlab hairmesh 1", "ply"), "line 1", "is not 'strandlab hairmesh 1'"},
        {sample_with("hairmesh 1", "hairmesh 2"), "line 1", "only version 1"},
        {sample_with("unit mm", "unit inch"), "line 5", "unit 'inch' is not m, cm or mm"},
        {sample_with("layers 2\n", ""), "line 9", "key 'layers' is missing"},
        {sample_with("faces 1\n", "face 1\n"), "line 8", "no key 'face', did you mean 'faces'?"},
        {sample_with("name patch", "name patch\nname patch"), "line 5", "key 'name' stands twice"},
        {sample_with("vertices 4", "vertices 4 4"), "line 6", "takes one value, not 2"},
        {sample_with("vertices 4", "vertices 1e9"), "line 6", "vertices 1e9 is not a whole number"},
        {sample_with("layers 2", "layers -1"), "line 7", "layers -1 is not a whole number"},
        {sample_with("vertices 4", "vertices 5"), "line 15", "uv of vertex 4 has 1 numbers"},
        {sample_with("20 20\n", "20 nan\n"), "line 13", "'nan' is not a number"},
        {sample_with("20 20\n", "20 1e300\n"), "line 13", "'1e300' is not a number"},
        {sample_with("20 20\n", "20 20 20\n"), "line 13", "has 3 numbers, not 2"},
        {sample_with("q 0 1 2 3", "q 0 1 2"), "line 16", "face q has 3 vertices, not 4"},
        {sample_with("q 0 1 2 3", "p 0 1 2 3"), "line 16", "face 'p' is not q or t"},
        {sample_with("q 0 1 2 3", "q 0 1 2 4"), "line 16", "vertex 4 is not a whole number from 0 to 3"},
        {sample_with("q 0 1 2 3", "q 0 1 2 2"), "line 16", "uses vertex 2 twice"},
        {sample_with("q 0 1 2 3", "q 3 2 1 0"), "line 16", "uv area -0.0002 m^2"},
        {sample_with("q 0 1 2 3", "t 0 1 2"), "line 14", "vertex 3 is in no face"},
        {sample_with("q 0 1 2 3\n", "q 0 1 2 3\nq 1 2 3 0\n"), "line 17", "'q 1' where 'layer 0' begins"},
        {sample_with("0 0 -20\n", "20 0 0\n"), "line 16", "face 0 is degenerate at vertex"},
        {sample_with("20 0 -20\n", "1 0 -1\n"), "line 16", "face 0 folds over itself"},
        {sample_with("20 0 0\n", "20 0\n"), "line 19", "vertex 1 of layer 0 has 2 numbers, not 3"},
        {sample_with("layer 1", "layer 2"), "line 22", "'layer 2' where 'layer 1' begins"},
        {sample_with("0 60 4\n", "0 30.5 2\n"), "line 28", "lies on that of layer 1"},
        {sample_with("31\n22 30 -20 31", "31\n22 30 -20 0", 2), "line 24",
         "w 0 of vertex 2 of layer 1 is not above 0"},
        {sample_with("0 0 0 0", "0 0 0 5", 2), "line 17", "w 5 of vertex 0 is not 0 at the root"},
        {sample_with("clump=0.5", "clump=2"), "line 9", "clump=2 is not a number from 0 to 1"},
        {sample_with("clump=0.5", "clamp=2"), "line 9", "no parameter 'clamp', did you mean 'clump'?"},
        {sample_with("clump=0.5", "clump"), "line 9", "'clump' is not key=value"},
        {sample_with("clump=0.5", "clump=0.5 clump=1"), "line 9", "'clump' stands twice"},
        {sample_with("clump=0.5", "strands=5"), "line 9", "'strands' is for who asks for strands"},
        {sample_with("frames layer", "frames tip", 1), "line 9", "frames 'tip' is not root or layer"},
        {valid + "0 0 0\n", "line 32", "text after the last layer"},
        {valid.substr(0, valid.size() - 20), "line 29", "it is truncated"},
        {valid.substr(0, valid.find("uv\n")), "line 9", "it is truncated"},
    };
    for (const Damage& damage : damages) {
        const std::string message = message_of([&] { read_text(damage.text); });
        EXPECT_TRUE(contains(message, "m.hairmesh: " + damage.line + ":") && contains(message, damage.reason))
            << "expected " << damage.line << " ... " << damage.reason << "\ngot      " << message;
    }
}

TEST(HairMeshFile, NeighboursMustAgree) {
    // Two triangles that run along their edge in the same direction, three at one edge, one folded back.
    std::string text = sample_with("t 0 2 3", "t 0 1 3", 1);
    text.replace(text.find("20 20\n"), 6, "20 20\n");
    EXPECT_TRUE(contains(message_of([&] { read_text(text); }), "as face 0 does"));
    const std::string folded = sample_with("20 0 -20\n0 0 -20\n", "20 0 -20\n20 0.1 -1\n", 1);
    EXPECT_TRUE(contains(message_of([&] { read_text(folded); }), "face 1 folds back over its neighbour 0") ||
                contains(message_of([&] { read_text(folded); }), "face 0 folds back over its neighbour 1"))
        << message_of([&] { read_text(folded); });
}

TEST(HairMeshFile, EveryTruncationIsRefused) {
    for (const std::string& text : samples::hair_meshes()) {
        const size_t last_line = text.rfind('\n', text.size() - 2);
        for (size_t n = 0; n <= last_line; ++n) {
            // A cut inside the last number of a line can leave a valid, shorter number.
            if (load_hair_mesh_bytes(samples::as_bytes(text.substr(0, n)))) ADD_FAILURE() << "cut to " << n;
        }
    }
}

TEST(HairMeshFile, RandomDamageNeverBreaksTheReader) {
    const std::vector<std::string> words{"nan",   "-1", "1e308", "0",  "q", "t",
                                         "layer", "uv", "#",     "\n", " ", "="};
    const auto all = samples::hair_meshes();
    size_t accepted = 0;
    for (uint64_t trial = 0; trial < 3000; ++trial) {
        Random random(21, 0, trial);
        std::string text = all[random.below(uint32_t(all.size()))];
        for (uint32_t i = 0, n = 1 + random.below(3); i < n; ++i) {
            const uint32_t at = random.below(uint32_t(text.size()));
            if (random.below(2) == 0)
                text[at] = static_cast<char>(random.bits());
            else
                text.replace(at, random.below(4), words[random.below(uint32_t(words.size()))]);
        }
        EXPECT_NO_THROW(accepted += load_hair_mesh_bytes(samples::as_bytes(text)))
            << "trial " << trial << "\n"
            << text;
    }
    EXPECT_GT(accepted, 100u);
    EXPECT_LT(accepted, 2900u);
}

TEST(HairMeshFile, StandsWhereAModelIsNamed) {
    const testing_tools::TestFolder folder;
    const std::string path = folder / "patch,1.hairmesh";
    write_hair_mesh(path, read_text(samples::hair_meshes()[0]));
    ImportReport report;
    EXPECT_EQ(load_model(path + ",strands=30", {}, report).strands.size(), 30u);
    EXPECT_EQ(load_model(path + ",strands=30,points=5", {}, report).curves.size(), 120u);
    const auto usage = [&](const std::string& spec) {
        return message_of([&] { load_model(spec, {}, report); }, ExitCode::usage);
    };
    EXPECT_TRUE(contains(usage(path + ",strand=3"), "no parameter 'strand', did you mean 'strands'?"));
    EXPECT_TRUE(contains(usage(path + ",points=1"), "points=1 is not 0"));
    EXPECT_TRUE(contains(usage(path + ",lod=0"), "lod=0 is not a number"));
    EXPECT_TRUE(contains(message_of([&] { load_model("nowhere.hairmesh,strands=3", {}, report); }),
                         "nowhere.hairmesh"));
}

}  // namespace
}  // namespace strandlab
