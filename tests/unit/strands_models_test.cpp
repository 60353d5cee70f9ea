// Models that exist as files: those of the repository, and real ones that may lie beside it.
#include "strands/bezier.h"
#include "strands/generators.h"
#include "strands/models.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace strandlab {
namespace {

using std::filesystem::path;

path source_folder() { return path(__FILE__).parent_path().parent_path().parent_path(); }

/// A real model, or "" when there is none here.
std::string shared_model(const std::string& name) {
    const char* folder = std::getenv("STRANDLAB_SHARED");
    const path file = (folder ? path(folder) : source_folder().parent_path() / "shared") / "models" / name;
    return std::filesystem::exists(file) ? file.string() : "";
}

TEST(BundledModels, AreWhatTheirReadmeSays) {
    std::ifstream readme(source_folder() / "models" / "README.md");
    if (!readme) GTEST_SKIP() << "models/README.md is not here";
    size_t count = 0;
    for (std::string line; std::getline(readme, line);) {
        const size_t spec = line.find("convert 'generate:"), output = line.find("' -o models/");
        if (spec == std::string::npos || output == std::string::npos) continue;
        const std::string file = line.substr(output + 5, line.find('`', output) - output - 5);
        ImportReport report;
        const Curves loaded = load_model(source_folder() / file, {}, report);
        EXPECT_EQ(hash(loaded), hash(generate(line.substr(spec + 9, output - spec - 9)))) << file;
        EXPECT_TRUE(warnings(report, {}).empty());
        ++count;
    }
    EXPECT_EQ(count, 3u);
}

struct RealModel {
    const char* file;
    size_t strands, curves;
    bool has_radii;
    double size;  // largest extent of its bounding box is between this and twice this
};

class RealModels : public testing::TestWithParam<RealModel> {};

TEST_P(RealModels, Load) {
    const std::string file = shared_model(GetParam().file);
    if (file.empty())
        GTEST_SKIP() << "no " << GetParam().file
                     << " (set STRANDLAB_SHARED to the folder that holds models/)";
    ImportReport report;
    const Curves curves = load_model(file, {}, report);
    EXPECT_EQ(curves.strands.size(), GetParam().strands);
    EXPECT_EQ(curves.curves.size() + report.repeated_points, GetParam().curves);
    EXPECT_EQ(report.radii_from_options, !GetParam().has_radii);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const Curve& curve : curves.curves)
        for (const glm::vec4& p : curve)
            low = glm::min(low, glm::vec3(p)), high = glm::max(high, glm::vec3(p));
    const glm::vec3 extent = high - low;
    const float largest = std::max({extent.x, extent.y, extent.z});
    EXPECT_GT(double(largest), GetParam().size);
    EXPECT_LT(double(largest), 2 * GetParam().size);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealModels,
                         testing::Values(RealModel{"fur/fur.hair", 50000, 150000, true, 2},
                                         RealModel{"ratboy/Ratboy_mohawk.tfx", 2228, 69068, false, 0.5},
                                         RealModel{"sintel/sintel_hair_16points.tfx", 11400, 171000, false,
                                                   0.2}));

}  // namespace
}  // namespace strandlab
