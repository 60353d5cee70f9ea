// Scene files: every kind of mistake, and one that traces right.
#include "command_line/files.h"
#include "command_line/program.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace strandlab::testing_tools {
namespace {

class ScenesTest : public CommandLineTest {
  protected:
    void SetUp() override {
        write_curves(path("a.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, 0.1f)});
        write_curves(path("b.npy"), {line_curve({0, -1, 0}, {0, 1, 0}, 0.05f),
                                     line_curve({0.5f, -1, 0}, {0.5f, 1, 0}, 0.05f)});
    }

    Outcome trace_scene(const std::string& scene) const {
        write("s.json", scene);
        write_rays(path("r.npy"), {ray_at(0)});
        return run({"trace", "--curves", "s.json", "--rays", "r.npy", "--primitive", "lss", "--device",
                    "cpu-float", "--out", "hits"});
    }
    void expect_refused(const std::string& scene, std::vector<std::string> parts) const {
        if (parts.empty() || !contains(parts.front(), "npy")) parts.push_back("s.json: ");
        expect_failure(trace_scene(scene), 5, parts);
        EXPECT_FALSE(exists("hits"));
    }
    /// A scene of one model with this entry for its only instance.
    static std::string with_instance(const std::string& entry) {
        return R"({"models": [{"file": "a.npy"}], "instances": [)" + entry + "]}";
    }
    static std::string with_model(const std::string& entry) { return R"({"models": [)" + entry + "]}"; }
};

TEST_F(ScenesTest, RefusesFilesThatAreNoScene) {
    for (const char* command : {"bench", "validate"})
        expect_last_line(run({command, "missing.json", "--device", "cpu-float"}), 5,
                         {"missing.json", "No such file"});
    expect_refused("", {"not JSON"});
    expect_refused("{\"models\": [", {"not JSON", "line 1"});
    expect_refused("{\n\"models\": \x1b\n}", {"not JSON", "line 2"});
    expect_refused(std::string(100000, '['), {"nested more than"});
    expect_refused("\xff\xfe", {"not JSON"});
    expect_refused("[]", {"the scene must be an object"});
    expect_refused("3", {"the scene must be an object"});
    expect_refused("{}", {"\"models\""});
    expect_refused(R"({"models": []})", {"at least one"});
    expect_refused(R"({"models": "a.npy"})", {"\"models\"", "list"});
    expect_refused(R"({"models": [{"file": "a.npy"}], "lights": []})", {"unknown key 'lights'"});
    expect_refused("{\"models\": [{\"file\": \"a.npy\"}], \"a\\nb\\u001b\": []}", {"unknown key 'a?b?'"});
}

TEST_F(ScenesTest, RefusesBadModels) {
    expect_refused(with_model("3"), {"models[0]", "object"});
    expect_refused(with_model("{}"), {"models[0]", "\"file\""});
    expect_refused(with_model(R"({"file": 3})"), {"models[0]", "file = 3"});
    expect_refused(with_model(R"({"file": ["a.npy"]})"), {"models[0]", "file = [\"a.npy\"]"});
    expect_refused(with_model(R"({"file": "missing.npy"})"), {"missing.npy", "No such file"});
    expect_refused(with_model(R"({"file": "a.npy", "strands": 3})"), {"models[0]", "strands = 3"});
    expect_refused(with_model(R"({"file": "a.npy", "strands": "missing.npy"})"), {"missing.npy"});
    expect_refused(with_model(R"({"file": "a.npy", "radius": "thick"})"),
                   {"models[0]", "radius = \"thick\""});
    expect_refused(with_model(R"({"file": "a.npy", "radius": -1})"), {"models[0]", "radius = -1"});
    expect_refused(with_model(R"({"file": "a.npy", "radius": 1e300})"), {"models[0]", "radius = 1e+300"});
    expect_refused(with_model(R"({"file": "a.npy", "radius_tip": null})"), {"radius_tip = null"});
    expect_refused(with_model(R"({"file": "a.npy", "unit_scale": 0})"), {"unit_scale = 0"});
    expect_refused(with_model(R"({"file": "a.npy", "scale": 2})"), {"models[0]", "unknown key 'scale'"});
    expect_refused(R"({"models": [{"file": "a.npy"}, {"file": true}]})", {"models[1]", "file = true"});
}

TEST_F(ScenesTest, RefusesBadInstances) {
    expect_refused(R"({"models": [{"file": "a.npy"}], "instances": {}})", {"instances must be a list"});
    expect_refused(R"({"models": [{"file": "a.npy"}], "instances": []})", {"at least one"});
    expect_refused(with_instance("0"), {"instances[0]", "object"});
    expect_refused(with_instance("{}"), {"instances[0]", "model = (missing)"});
    expect_refused(with_instance(R"({"model": 1})"), {"instances[0]", "model = 1", "0 to 0"});
    expect_refused(with_instance(R"({"model": -1})"), {"model = -1"});
    expect_refused(with_instance(R"({"model": 0.5})"), {"model = 0.5"});
    expect_refused(with_instance(R"({"model": "0"})"), {"model = \"0\""});
    expect_refused(with_instance(R"({"model": 0, "move": []})"), {"unknown key 'move'"});
    expect_refused(with_instance(R"({"model": 0, "transform": 1})"), {"12 numbers"});
    expect_refused(with_instance(R"({"model": 0, "transform": [1,0,0,0, 0,1,0,0, 0,0,1]})"), {"12 numbers"});
    expect_refused(with_instance(R"({"model": 0, "transform": [1,0,0,"x", 0,1,0,0, 0,0,1,0]})"),
                   {"transform[3] = \"x\""});
    expect_refused(with_instance(R"({"model": 0, "transform": [1,0,0,1e300, 0,1,0,0, 0,0,1,0]})"),
                   {"transform[3] = 1e+300"});
    expect_refused(with_instance(R"({"model": 0, "transform": [1,0,0,0, 0,1,0,0, 0,0,0,0]})"), {"flattens"});
}

TEST_F(ScenesTest, TracesTwoModelsAndThreeInstances) {
    write("s.json", R"({"models": [{"file": "a.npy"}, {"file": "b.npy"}], "instances": [
        {"model": 0},
        {"model": 0, "transform": [1,0,0,2, 0,1,0,0, 0,0,1,-1]},
        {"model": 1, "transform": [2,0,0,-3, 0,2,0,0, 0,0,2,0]}]})");
    std::vector<Ray> rays{ray_at(0), ray_at(2), ray_at(-3),      ray_at(-2),
                          ray_at(1), ray_at(0), ray_at(-3, 1.5f)};
    rays[5].direction.z = -2;
    write_rays(path("r.npy"), rays);
    const std::vector<float> t{4.9f, 5.9f, 4.9f, 4.9f, INFINITY, 2.45f, 4.9f};
    const std::vector<int32_t> curve{0, 0, 1, 2, -1, 0, 1};
    std::vector<std::string> devices{"cpu-float", "cpu-double"};
    if (why_no_device().empty()) devices.emplace_back("");
    for (const std::string& device : devices)
        for (const char* primitive : {"lss", "prhi", "rocaps"}) {
            Arguments arguments{"trace",       "--curves", "s.json", "--rays", "r.npy",
                                "--primitive", primitive,  "--out",  "hits"};
            if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
            expect_success(run(arguments));
            const auto found = read_npy<float>(ByteSource::from_file(path("hits/t.npy")), {"<f4", {}});
            const auto curves = read_npy<int32_t>(ByteSource::from_file(path("hits/curve.npy")), {"<i4", {}});
            const auto normals =
                read_npy<glm::vec3>(ByteSource::from_file(path("hits/normal.npy")), {"<f4", {3}});
            EXPECT_EQ(curves, curve) << primitive << " on " << device;
            ASSERT_EQ(found.size(), t.size());
            for (size_t i = 0; i < t.size(); ++i) {
                const bool is_same =
                    std::isinf(t[i]) ? std::isinf(found[i]) : std::abs(found[i] - t[i]) < 1e-4f;
                EXPECT_TRUE(is_same) << primitive << " on " << device << ": " << found[i] << " != " << t[i];
                EXPECT_NEAR(normals[i].z, std::isfinite(t[i]) ? 1 : 0, 1e-3f);
            }
            const std::string caps = std::string(primitive) == "prhi" ? "open" : "round";
            const Outcome errors = run({"compare", "--curves", "s.json", "--rays", "r.npy", "--hits", "hits",
                                        "--surface", primitive, "--caps", caps, "--json"});
            expect_success(errors);
            const nlohmann::json decisive = nlohmann::json::parse(errors.output).at("decisive");
            EXPECT_EQ(decisive.at("matches"), 6) << errors.output;
            EXPECT_EQ(decisive.at("wrong_strand").at("count"), 0) << errors.output;
        }
}

}  // namespace
}  // namespace strandlab::testing_tools
