// Model files that are damaged, hostile, odd or empty.
#include "command_line/files.h"
#include "command_line/program.h"

#include <cmath>
#include <limits>

namespace strandlab::testing_tools {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

class ModelsTest : public CommandLineTest {
  protected:
    /// Reading the model must fail in one line that names the file, and leave the output as it was.
    void expect_refused(const std::string& name, std::vector<std::string> parts) const {
        write("out.npy", "old");
        parts.push_back(name);
        expect_failure(run({"convert", name, "-o", "out.npy"}), 5, parts);
        EXPECT_EQ(read("out.npy"), "old");
    }

    void expect_refused(const std::string& name, const std::string& bytes,
                        const std::vector<std::string>& parts) const {
        write(name, bytes);
        expect_refused(name, parts);
    }

    /// Loads the model and traces a ray: an ordinary result of this many hits, and one warning with the part.
    void expect_odd(const std::string& name, const std::string& warning, const Ray& ray, size_t hits) const {
        write_rays(path("rays.npy"), {ray});
        for (const char* primitive : {"lss", "prhi", "rocaps", "dots"}) {
            const Outcome outcome = run({"trace", "--curves", name, "--rays", "rays.npy", "--primitive",
                                         primitive, "--device", "cpu-float", "--out", "hits", "--quiet"});
            expect_success(outcome);
            EXPECT_EQ(outcome.output, "");
            EXPECT_EQ(outcome.log_lines().size(), warning.empty() ? 0u : 1u) << outcome.log;
            EXPECT_TRUE(contains(outcome.log, warning)) << outcome.log;
            const std::vector<float> t =
                read_npy<float>(ByteSource::from_file(path("hits/t.npy")), {"<f4", {}});
            ASSERT_EQ(t.size(), 1u);
            EXPECT_EQ(std::isfinite(t[0]), hits == 1) << name << " " << primitive << " " << t[0];
            EXPECT_FALSE(std::isnan(t[0]));
        }
    }
};

TEST_F(ModelsTest, RefusesAnOutputBeforeTheModelIsRead) {
    expect_failure(run({"convert", "missing.hair", "-o", "out.obj"}), 5, {"out.obj", "'.obj'", ".npy"});
    expect_failure(run({"convert", "missing.hair", "-o", "out.hair", "--write-strands", "s.npy"}), 2,
                   {"out.hair", "s.npy"});
}

TEST_F(ModelsTest, RefusesWhatIsNoModelFile) {
    std::filesystem::create_directory(path("folder.hair"));
    expect_refused("missing.hair", {"No such file"});
    expect_refused("folder.hair", {"directory"});
    expect_refused("model.obj", "v 0 0 0", {"'.obj'", ".hair", ".tfx"});
    expect_refused("noextension", "x", {"extension ''", ".hair"});
    expect_refused("text.hair",
                   "this is no hair file, but long enough to hold a whole header of 128 bytes: "
                   "................................................................",
                   {"HAIR"});
    expect_refused("nothing.hair", "", {});
    expect_refused("nothing.tfx", "", {});
    expect_refused("nothing.data", "", {});
    expect_refused("nothing.npy", "", {});
    for (const char* command : {"bench", "validate"})
        expect_last_line(run({command, "missing.hair", "--device", "cpu-float"}), 5, {"missing.hair"});
    expect_failure(run({"convert", "generate:harid", "-o", "x.npy"}), 2, {"generate:harid", "there are"});
    expect_failure(run({"convert", "generate:head,strnads=3", "-o", "x.npy"}), 2,
                   {"'strnads'", "did you mean 'strands'?"});
}

TEST_F(ModelsTest, RefusesDamagedHairFiles) {
    const std::string good = hair_file({3, 2});
    expect_refused("short.hair", good.substr(0, 100), {"128"});
    expect_refused("cut.hair", good.substr(0, good.size() - 7), {});
    expect_refused("long.hair", good + "x", {});
    expect_refused("strands.hair", with(good, 4, 0xFFFFFFFFu), {"4294967295"});
    expect_refused("points.hair", with(good, 8, 0xFFFFFFFFu), {"4294967295"});
    expect_refused("flags.hair", with(good, 12, 4u), {});
    expect_refused("sum.hair", with(good, 128, uint16_t(9)), {});
    expect_refused("nan.hair", with(good, 132, nan), {"nan"});
    expect_refused("inf.hair", with(good, 136, inf), {"inf"});
    expect_refused("huge.hair", with(good, 136, 1e30f), {"1e+30"});
    expect_refused("thick.hair", with(good, 132 + 60, nan), {"nan"});
}

TEST_F(ModelsTest, RefusesDamagedTressFxAndDataFiles) {
    const std::string tfx = tfx_file(2), data = data_file({3, 2});
    expect_refused("short.tfx", tfx.substr(0, 90), {});
    expect_refused("cut.tfx", tfx.substr(0, tfx.size() - 1), {});
    expect_refused("long.tfx", tfx + "x", {});
    expect_refused("version.tfx", with(tfx, 0, 3.0f), {"version 3"});
    expect_refused("strands.tfx", with(tfx, 4, 0xFFFFFFFFu), {});
    expect_refused("points.tfx", with(tfx, 8, 0xFFFFFFFFu), {});
    expect_refused("none.tfx", with(tfx, 8, 0u), {"0 points per strand"});
    expect_refused("inside.tfx", with(tfx, 12, 8u), {"offset 8"});
    expect_refused("outside.tfx", with(tfx, 12, 0xFFFFFFF0u), {"4294967280"});
    expect_refused("nan.tfx", with(tfx, 160, nan), {"nan"});
    expect_refused("cut.data", data.substr(0, data.size() - 1), {});
    expect_refused("long.data", data + "x", {});
    expect_refused("negative.data", with(data, 0, -1), {"-1"});
    expect_refused("many.data", with(data, 0, 0x7FFFFFFF), {});
    expect_refused("points.data", with(data, 4, 0x7FFFFFFF), {});
    expect_refused("less.data", with(data, 4, -2), {"-2"});
    expect_refused("nan.data", with(data, 8, nan), {"nan"});
}

TEST_F(ModelsTest, RefusesDamagedCurveFiles) {
    const std::vector<float> curve(16, 1.0f);
    const std::string good = npy_floats("(1, 4, 4)", curve);
    expect_refused("cut.npy", good.substr(0, good.size() - 1), {});
    expect_refused("long.npy", good + "x", {});
    expect_refused("header.npy", good.substr(0, 40), {});
    expect_refused("magic.npy", "NUMPY" + good, {"not a .npy file"});
    expect_refused("count.npy", npy_floats("(1152921504606846977, 4, 4)", curve), {"shape"});
    expect_refused("shape.npy", npy_floats("(4, 4)", curve), {"'shape' is (4, 4)"});
    expect_refused("nan.npy", with(good, 128, nan), {"nan"});
    expect_refused(
        "double.npy",
        npy_file("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4, 4), }", std::string(128, '\0')),
        {"'<f8'", "a.astype('<f4')"});
    expect_refused(
        "order.npy",
        npy_file("{'descr': '<f4', 'fortran_order': True, 'shape': (1, 4, 4), }", std::string(64, '\0')),
        {"ascontiguousarray"});
    expect_refused("python.npy", npy_file("__import__('os')", ""), {});
    write("good.npy", good);
    const auto with_strands = [&](const std::string& shape, const std::string& data) {
        write("s.npy", npy_file("{'descr': '<i4', 'fortran_order': False, 'shape': " + shape + ", }", data));
        return run({"convert", "good.npy", "--strands", "s.npy", "-o", "out.hair"});
    };
    expect_success(with_strands("(1, 2)", bytes_of(0, 1)));
    expect_failure(with_strands("(1, 2)", bytes_of(0, 2)), 5, {"s.npy"});
    expect_failure(with_strands("(1, 2)", bytes_of(-1, 1)), 5, {"s.npy"});
    expect_failure(with_strands("(1, 2)", bytes_of(0, -1)), 5, {"s.npy"});
    expect_failure(with_strands("(2,)", bytes_of(0, 1)), 5, {"s.npy", "'shape' is (2,)"});
    write("s.npy", npy_floats("(1, 2)", {0, 1}));
    expect_failure(run({"convert", "good.npy", "--strands", "s.npy", "-o", "out.hair"}), 5,
                   {"s.npy", "'<f4'", "<i4"});
    write("model.hair", hair_file({2}));
    expect_failure(run({"convert", "model.hair", "--strands", "s.npy", "-o", "out.hair"}), 2, {"s.npy"});
}

TEST_F(ModelsTest, LeavesOutWhatIsNoStrand) {
    // One point, then three, then the same point twice.
    std::string points = data_file({0, 1, 3, 2});
    points = with(points, points.size() - 8, 0.0f);
    write("odd.data", points);
    write_rays(path("rays.npy"), {ray_at(0, 0.15f)});
    const Outcome outcome = run({"trace", "--curves", "odd.data", "--rays", "rays.npy", "--primitive", "lss",
                                 "--device", "cpu-float", "--out", "hits", "--quiet"});
    expect_success(outcome);
    EXPECT_TRUE(contains(outcome.log, "warning: odd.data: 3 strands with fewer than two distinct points"))
        << outcome.log;
    EXPECT_TRUE(contains(outcome.log, "1 repeated points were dropped")) << outcome.log;
    EXPECT_TRUE(contains(outcome.log, "has no radii: 3.5e-05 at the root to 1e-05")) << outcome.log;
    EXPECT_EQ(read_npy<int32_t>(ByteSource::from_file(path("hits/curve.npy")), {"<i4", {}}).at(0), 1);
}

TEST_F(ModelsTest, TracesOddCurves) {
    const Curve line = line_curve({0, -1, 0}, {0, 1, 0}, 0.1f);
    write_curves(path("point.npy"), {line_curve({0, 0, 0}, {0, 0, 0}, 0.1f), line});
    expect_odd("point.npy", "", ray_at(0, 0.5f), 1);
    write_curves(path("repeated.npy"), {Curve{line[0], line[0], line[3], line[3]}});
    expect_odd("repeated.npy", "", ray_at(0, 0.5f), 1);
    write_curves(path("negative.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, -0.1f)});
    expect_odd("negative.npy", "4 negative radii were set to 0", ray_at(0.05f, 0.5f), 0);
    write_curves(path("zero.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, 0.0f)});
    expect_odd("zero.npy", "", ray_at(0.05f, 0.5f), 0);
    // Every curve that is known to break intersectors, in one model.
    const Outcome all = run({"bench", "generate:case", "--device", "cpu-float", "--resolution", "32x32"});
    expect_success(all);
}

TEST_F(ModelsTest, AnEmptyModelIsNoError) {
    write("empty.npy", npy_floats("(0, 4, 4)", {}));
    write("empty.hair", hair_file({}));
    for (const std::string name : {"empty.npy", "empty.hair"}) {
        expect_odd(name, "no curve in it", ray_at(0), 0);
        for (const char* command : {"bench", "validate"}) {
            const Outcome outcome = run({command, name, "--device", "cpu-float"});
            expect_success(outcome);
            EXPECT_TRUE(contains(outcome.log, name + ": no curve in it")) << outcome.log;
        }
        expect_success(run({"convert", name, "-o", "again.hair"}));
        EXPECT_EQ(read("again.hair").size(), 128u);
#ifdef STRANDLAB_IMAGES
        expect_last_line(run({"render", name, "-o", "x.png", "--device", "cpu-float"}), 5,
                         {name, "no curve to render"});
        EXPECT_FALSE(exists("x.png"));
#endif
    }
}

}  // namespace
}  // namespace strandlab::testing_tools
