// Readers and writers of the model formats: what they accept, and what they say of what they do not.
#include "base/file.h"
#include "base/npy.h"
#include "fuzz/samples.h"
#include "strands/generators.h"
#include "strands/models.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace strandlab {
namespace {

using testing_tools::message_of;
using testing_tools::TestFolder;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

ByteSource source_of(const std::string& bytes) {
    return ByteSource::from_memory("input", samples::as_bytes(bytes));
}

template <class T>
std::string with(std::string bytes, size_t offset, T value) {
    std::memcpy(&bytes[offset], &value, sizeof(value));
    return bytes;
}

Strands hair_of(const std::string& bytes) {
    ImportReport report;
    return load_hair(source_of(bytes), report);
}
Strands tfx_of(const std::string& bytes) {
    ImportReport report;
    return load_tfx(source_of(bytes), report);
}
Strands data_of(const std::string& bytes) {
    ImportReport report;
    return load_data(source_of(bytes), report);
}
Curves npy_of(const std::string& bytes) {
    ImportReport report;
    return load_npy_curves(source_of(bytes), nullptr, report);
}
Curves npy_of(const std::string& bytes, const std::string& strands) {
    ImportReport report;
    const ByteSource strand_source = ByteSource::from_memory("strands", samples::as_bytes(strands));
    return load_npy_curves(source_of(bytes), &strand_source, report);
}

TEST(HairFile, ReadsSegmentsThicknessAndSkipsTheRest) {
    const Strands strands = hair_of(samples::hair(29, {2, 0, 4}, 0.1f));
    EXPECT_EQ(strands.first_point, (std::vector<uint32_t>{0, 3, 4, 9}));
    EXPECT_EQ(strands.points[1], glm::vec4(0.1f, 0.02f, -0.3f, 0.5f * (0.02f - 0.001f)));
}

TEST(HairFile, UsesDefaultSegmentsAndThickness) {
    const Strands strands = hair_of(samples::hair(0, {3, 3}, 0.5f));
    EXPECT_EQ(strands.first_point, (std::vector<uint32_t>{0, 4, 8}));
    EXPECT_EQ(strands.points[0].w, 0.25f);
    EXPECT_LT(hair_of(samples::hair(0, {3}, 0.0f)).points[0].w, 0);
    EXPECT_LT(hair_of(samples::hair(0, {3}, nan_value)).points[0].w, 0);
}

TEST(HairFile, CountsNegativeThickness) {
    ImportReport report;
    const std::string bytes = with(samples::hair(4, {1}), 128 + 2 * 12, -1.0f);
    EXPECT_EQ(load_hair(source_of(bytes), report).points[0].w, 0);
    EXPECT_EQ(report.negative_radii, 1u);
}

TEST(HairFile, RefusesDamage) {
    const std::string good = samples::hair(5, {3, 1});  // 128 + 4 + 6 * 12 + 6 * 4 bytes
    EXPECT_MESSAGE(hair_of(""),
                   "input: header: 128 x 1 bytes at offset 0 do not fit into the file's 0 bytes");
    EXPECT_MESSAGE(hair_of(with(good, 0, 'X')), "not a .hair file");
    EXPECT_MESSAGE(hair_of(with(good, 12, 4u)), "flags 0x4 at offset 12 must hold 0x2");
    EXPECT_MESSAGE(hair_of(with(good, 12, 0x26u)), "flags 0x26 at offset 12");
    EXPECT_MESSAGE(hair_of(good.substr(0, good.size() - 1)), "need 228 bytes, the file has 227");
    EXPECT_MESSAGE(hair_of(good + "x"), "need 228 bytes, the file has 229");
    EXPECT_MESSAGE(hair_of(with(good, 8, 0xFFFFFFFFu)), "4294967295 points");
    EXPECT_MESSAGE(hair_of(with(good, 128, uint16_t(9))),
                   "the strands have 12 points together (segments array at 128), the header says 6");
    EXPECT_MESSAGE(hair_of(with(samples::hair(4, {3}), 16, 0xFFFFFFFFu)),
                   "the strands have 4294967296 points together (4294967295 segments each)");
    EXPECT_MESSAGE(hair_of(with(samples::hair(4, {3}), 4, 0xFFFFFFFFu)), "the header says 4 at offset 8");
    EXPECT_MESSAGE(hair_of(with(good, 132 + 2 * 12 + 4, nan_value)),
                   "point 2 at offset 156 is (0.2, nan, -0.3)");
    EXPECT_MESSAGE(hair_of(with(good, 132 + 6 * 12 + 8, nan_value)),
                   "thickness nan of point 2 at offset 212");
}

TEST(TfxFile, ReadsPositionsWithoutTheirPinning) {
    for (const bool coordinates : {false, true}) {
        const Strands strands = tfx_of(samples::tfx(2, 4, coordinates));
        EXPECT_EQ(strands.first_point, (std::vector<uint32_t>{0, 4, 8}));
        for (const glm::vec4& p : strands.points) EXPECT_EQ(p.w, -1);
        EXPECT_EQ(glm::vec3(strands.points[1]), glm::vec3(0.1f, 0.02f, -0.3f));
    }
}

TEST(TfxFile, RefusesDamage) {
    const std::string good = samples::tfx(2, 4, true);  // 160 + 128 + 16 bytes
    EXPECT_MESSAGE(tfx_of("TFX"), "header: 160 x 1 bytes");
    EXPECT_MESSAGE(tfx_of(with(good, 0, 3.0f)), "version 3 at offset 0 is not 4");
    EXPECT_MESSAGE(tfx_of(with(good, 0, nan_value)), "version nan");
    EXPECT_MESSAGE(tfx_of(with(good, 8, 0u)), "0 points per strand");
    EXPECT_MESSAGE(tfx_of(with(good, 12, 0u)), "at offset 0");
    EXPECT_MESSAGE(tfx_of(with(good, 12, 100u)), "offset 100 of the positions lies inside the header");
    EXPECT_MESSAGE(tfx_of(with(good, 12, 0xFFFFFF00u)),
                   "positions: 8 x 16 bytes at offset 4294967040 do not fit");
    EXPECT_MESSAGE(tfx_of(with(good, 16, 300u)), "strand coordinates: 2 x 8 bytes at offset 300");
    EXPECT_MESSAGE(tfx_of(with(with(good, 4, 0xFFFFFFFFu), 8, 0xFFFFFFFFu)),
                   "positions: 18446744065119617025 x 16 bytes");
    EXPECT_MESSAGE(tfx_of(good.substr(0, 200)), "do not fit into the file's 200 bytes");
    EXPECT_MESSAGE(tfx_of(good + "x"), "end at offset 304, the file has 305 bytes");
    EXPECT_MESSAGE(tfx_of(with(good, 160 + 16, std::numeric_limits<float>::infinity())),
                   "point 1 at offset 176 is (inf");
}

TEST(DataFile, ReadsStrandsOfAnyLength) {
    const Strands strands = data_of(samples::data({3, 1, 0, 5}));
    EXPECT_EQ(strands.first_point, (std::vector<uint32_t>{0, 3, 4, 4, 9}));
    EXPECT_EQ(data_of(samples::data({})).size(), 0u);
}

TEST(DataFile, RefusesDamage) {
    const std::string good = samples::data({3, 2});  // 4 + 4 + 36 + 4 + 24 bytes
    EXPECT_MESSAGE(data_of("abc"), "number of strands expected at offset 0, the file has 3 bytes");
    EXPECT_MESSAGE(data_of(with(good, 0, -2)), "number of strands -2 at offset 0 is negative");
    EXPECT_MESSAGE(data_of(with(good, 0, 0x7FFFFFFF)), "strands: 2147483647 x 4 bytes at offset 4");
    EXPECT_MESSAGE(data_of(with(good, 0, 3)), "number of points expected at offset 72");
    EXPECT_MESSAGE(data_of(with(good, 44, -1)), "number of points -1 at offset 44 is negative");
    EXPECT_MESSAGE(data_of(with(good, 4, 0x7FFFFFFF)), "points: 2147483647 x 12 bytes at offset 8");
    EXPECT_MESSAGE(data_of(good + "x"), "2 strands end at offset 72, the file has 73 bytes");
    EXPECT_MESSAGE(data_of(with(good, 12, nan_value)), "point at offset 8 is (0, nan, -0.3)");
}

TEST(NpyFile, FindsStrandsBySharedEndPoints) {
    const Curves curves = npy_of(samples::npy_curves(5));
    ASSERT_EQ(curves.strands.size(), 3u);
    EXPECT_EQ(curves.strands[1].first, 2u);
    EXPECT_EQ(curves.strands[1].count, 2u);
    EXPECT_EQ(curves.strands[2].count, 1u);
}

TEST(NpyFile, ReadsStrandsAndCountsGaps) {
    const std::string strands = samples::npy_strands({0, 3, 3, 0, 3, 1});
    const ByteSource strand_source = ByteSource::from_memory("strands", samples::as_bytes(strands));
    ImportReport report;
    const Curves curves = load_npy_curves(source_of(samples::npy_curves(4)), &strand_source, report);
    ASSERT_EQ(curves.strands.size(), 2u);
    EXPECT_EQ(report.gaps, 1u);
    EXPECT_EQ(report.short_strands, 1u);
}

TEST(NpyFile, RefusesDamage) {
    const std::string good = samples::npy_curves(4);
    const size_t data = good.size() - 256;
    EXPECT_MESSAGE(npy_of(with(good, data + 64 + 16, nan_value)), "[1, 1] at offset");
    EXPECT_MESSAGE(npy_of(samples::npy_strands({0, 1})), "'descr' is '<i4', need '<f4'");
    EXPECT_MESSAGE(npy_of(good, good), "strands: 'descr' is '<f4', need '<i4'");
    EXPECT_MESSAGE(npy_of(good, samples::npy_strands({0, 2, 3, 1})),
                   "strands: row 1 is (3, 1): must begin at curve 2");
    EXPECT_MESSAGE(npy_of(good, samples::npy_strands({0, 5})),
                   "row 0 is (0, 5): must begin at curve 0 and end within 4 curves");
    EXPECT_MESSAGE(npy_of(good, samples::npy_strands({0, -1})), "row 0 is (0, -1)");
    EXPECT_MESSAGE(npy_of(good, samples::npy_strands({0, 3})), "1 rows end at curve 3, there are 4 curves");
}

TEST(Models, RoundTripsNpyBitForBit) {
    const TestFolder folder;
    const Curves curves = generate("generate:head,strands=50,points=9,style=wavy");
    ImportReport report;
    write_model(folder / "a.npy", curves);
    EXPECT_EQ(hash(load_model(folder / "a.npy", {}, report)), hash(curves));
    WriteOptions options;
    options.strands_path = folder / "s.npy";
    write_model(folder / "b.npy", curves, options);
    EXPECT_EQ(hash(load_model(folder / "b.npy", {}, report, folder / "s.npy")), hash(curves));
    EXPECT_TRUE(warnings(report, {}).empty());
}

TEST(Models, RoundTripsHairThroughItsPoints) {
    const TestFolder folder;
    for (const char* spec : {"generate:wavy,strands=40,points=9", "generate:head,strands=1,points=2"}) {
        const Curves curves = generate(spec);
        ImportReport report;
        write_model(folder / "a.hair", curves);
        EXPECT_EQ(hash(load_model(folder / "a.hair", {}, report)), hash(curves)) << spec;
    }
    Curves uneven = generate("generate:wavy,strands=3,points=5");
    uneven.curves.pop_back();
    --uneven.strands.back().count;
    WriteOptions options;
    options.points_per_curve = 3;
    write_model(folder / "b.hair", uneven, options);
    CurveOptions linear;
    linear.basis = Basis::linear;
    ImportReport report;
    const Curves read = load_model(folder / "b.hair", linear, report);
    EXPECT_EQ(read.curves.size(), uneven.curves.size() * 3);
    EXPECT_EQ(read.strands.back().count, 9u);
    EXPECT_EQ(read.curves.back()[3], uneven.curves.back()[3]);
}

TEST(Models, RefusesToWriteWhatTheFormatCannotHold) {
    const TestFolder folder;
    Curves split = generate("generate:straight,strands=1,points=3");
    split.strands = {{0, 1}, {1, 1}};
    EXPECT_MESSAGE(write_model(folder / "a.npy", split),
                   "the end points alone would not give the 2 strands back");
    const Curves curves = generate("generate:straight,strands=2,points=1001");
    WriteOptions options;
    options.points_per_curve = 66;
    EXPECT_MESSAGE(write_model(folder / "a.hair", curves, options),
                   "strand 0 needs 66001 points, .hair holds at most 65536");
    EXPECT_EQ(folder.entries(), 0u);
    EXPECT_MESSAGE(write_model(folder / "none/a.hair", curves), "cannot write: No such file or directory");
}

TEST(Models, NamesTheKnownExtensions) {
    ImportReport report;
    EXPECT_MESSAGE(load_model("a/b.abc", {}, report),
                   "a/b.abc: extension '.abc' cannot be read; it must be .data, .hair, .npy or .tfx");
    EXPECT_MESSAGE(load_model("a.hair/b", {}, report), "extension ''");
    EXPECT_MESSAGE(write_model("a.tfx", {}), "extension '.tfx' cannot be written; it must be .hair or .npy");
    EXPECT_MESSAGE(load_model("none.HAIR", {}, report), "none.HAIR: cannot read: No such file");
    EXPECT_NE(message_of([&] { load_model("a.hair", {}, report, "s.npy"); }, ExitCode::usage)
                  .find(".npy curves only"),
              std::string::npos);
    EXPECT_NE(message_of([&] { load_model("generate:fur", {}, report, "s.npy"); }, ExitCode::usage)
                  .find(".npy curves only"),
              std::string::npos);
}

TEST(Models, AppliesOptionsToCurveFiles) {
    const TestFolder folder;
    write_file(folder / "a.npy", samples::npy_curves(2));
    CurveOptions options;
    options.unit_scale = 2;
    options.override_radii = true;
    options.root_radius = 6;
    options.tip_radius = 0;
    ImportReport report;
    const Curves curves = load_model(folder / "a.npy", options, report);
    EXPECT_FLOAT_EQ(curves.curves[0][1].x, 0.2f);
    EXPECT_FLOAT_EQ(curves.curves[0][1].w, 5);
    EXPECT_FLOAT_EQ(curves.curves[1][0].w, 3);
    EXPECT_FLOAT_EQ(curves.curves[1][3].w, 0);
    const std::string bytes = samples::npy_curves(2);
    write_file(folder / "b.npy", with(bytes, bytes.size() - 4, -1.0f));
    EXPECT_EQ(load_model(folder / "b.npy", {}, report).curves[1][3].w, 0);
    EXPECT_EQ(report.negative_radii, 1u);
}

}  // namespace
}  // namespace strandlab
