// Files of rays, and hits that other programs wrote.
#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace strandlab::testing_tools {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

class RaysTest : public CommandLineTest {
  protected:
    void SetUp() override {
        write_curves(path("c.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, 0.1f)});
        write_rays(path("r.npy"), {ray_at(0), ray_at(0.05f, 0.3f), ray_at(0.5f)});
    }

    Outcome trace(const std::string& rays) const {
        return run({"trace", "--curves", "c.npy", "--rays", rays, "--primitive", "rocaps", "--caps", "round",
                    "--device", "cpu-float", "--out", "hits"});
    }
    Outcome compare(const Arguments& more = {}) const {
        Arguments arguments{"compare", "--curves", "c.npy", "--rays", "r.npy", "--hits", "hits"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

TEST_F(RaysTest, InvalidRaysMissAndAreCounted) {
    std::vector<Ray> rays(8, ray_at(0));
    rays[1].origin.x = nan;
    rays[2].direction.z = -inf;
    rays[3].direction.z = 0;
    rays[4].tmin = 3, rays[4].tmax = 2;
    rays[5].tmax = nan;
    rays[6].tmin = -1;
    write_rays(path("bad.npy"), rays);
    for (const char* device : {"cpu-float", ""}) {
        if (device[0] == '\0' && !why_no_device().empty()) continue;
        Arguments arguments{"trace",       "--curves", "c.npy", "--rays", "bad.npy",
                            "--primitive", "lss",      "--out", "hits",   "--quiet"};
        if (device[0] != '\0') arguments.insert(arguments.end(), {"--device", device});
        const Outcome outcome = run(arguments);
        expect_success(outcome);
        EXPECT_EQ(outcome.log_lines().size(), 1u) << outcome.log;
        EXPECT_TRUE(contains(outcome.log, "warning: bad.npy: 6 rays")) << outcome.log;
        const auto t = read_npy<float>(ByteSource::from_file(path("hits/t.npy")), {"<f4", {}});
        const auto curve = read_npy<int32_t>(ByteSource::from_file(path("hits/curve.npy")), {"<i4", {}});
        for (const size_t i : {0, 7}) EXPECT_NEAR(t.at(i), 4.9f, 1e-5f);
        for (size_t i = 1; i < 7; ++i) {
            EXPECT_EQ(t.at(i), inf) << i;
            EXPECT_EQ(curve.at(i), -1) << i;
        }
    }
}

TEST_F(RaysTest, RefusesFilesThatHoldNoRays) {
    write("double.npy",
          npy_file("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 8), }", std::string(64, '\0')));
    write("seven.npy", npy_floats("(2, 7)", std::vector<float>(14)));
    write("flat.npy", npy_floats("(16,)", std::vector<float>(16)));
    write("cut.npy", npy_floats("(3, 8)", std::vector<float>(23)));
    write("none.npy", npy_floats("(0, 8)", {}));
    expect_failure(trace("double.npy"), 5, {"double.npy", "'<f8'", "'<f4'"});
    expect_failure(trace("seven.npy"), 5, {"seven.npy", "(2, 7)", "(N, 8)"});
    expect_failure(trace("flat.npy"), 5, {"flat.npy", "(16,)"});
    expect_failure(trace("cut.npy"), 5, {"cut.npy", "96", "92"});
    expect_failure(trace("none.npy"), 5, {"none.npy"});
    expect_failure(trace("missing.npy"), 5, {"missing.npy", "No such file"});
    expect_last_line(run({"bench", "c.npy", "--device", "cpu-float", "--rays", "seven.npy"}), 5,
                     {"seven.npy", "(2, 7)"});
    EXPECT_FALSE(exists("hits"));
}

TEST_F(RaysTest, ComparesHitsOfOtherPrograms) {
    expect_success(trace("r.npy"));
    const Outcome table = compare();
    expect_success(table);
    EXPECT_EQ(table.log, "");
    for (const char* surface : {"rocaps", "rocaps:variant=published"})
        expect_success(compare({"--surface", surface, "--json"}));
    expect_failure(compare({"--surface", "sphre"}), 2, {"sphre"});
    expect_failure(compare({"--surface", "disc"}), 2, {"--caps round", "--caps open"});
    expect_failure(compare({"--caps", "square"}), 2, {"--caps square"});
    expect_failure(compare({"--error-rays", "-1"}), 2, {"--error-rays", "-1"});
}

TEST_F(RaysTest, RefusesHitsThatDoNotFit) {
    expect_failure(compare(), 5, {"hits", "No such file"});
    expect_success(trace("r.npy"));
    const std::string t = read("hits/t.npy"), curve = read("hits/curve.npy");
    write("hits/t.npy", npy_floats("(2,)", {1, 2}));
    expect_failure(compare(), 5, {"hits/t.npy", "2 items", "3 rays"});
    write("hits/t.npy", npy_floats("(3, 1)", {1, 2, 3}));
    expect_failure(compare(), 5, {"hits/t.npy", "(3, 1)"});
    write("hits/t.npy", t);
    write("hits/curve.npy", npy_floats("(3,)", {0, 0, 0}));
    expect_failure(compare(), 5, {"hits/curve.npy", "'<i4'"});
    write("hits/curve.npy", with(curve, curve.size() - 4, 0));
    expect_failure(compare(), 5, {"hits", "ray 2", "t = +inf and curve -1"});
    // A curve that there is not, and a NaN, are errors of whoever wrote them: counted, not refused.
    write("hits/curve.npy", with(curve, curve.size() - 12, 7));
    write("hits/t.npy", with(t, t.size() - 8, nan));
    const Outcome counted = compare({"--json"});
    expect_success(counted);
    const nlohmann::json all = nlohmann::json::parse(counted.output).at("all");
    EXPECT_EQ(all.at("wrong_strand").at("count"), 1);
    EXPECT_EQ(all.at("nan").at("count"), 1);
}

}  // namespace
}  // namespace strandlab::testing_tools
