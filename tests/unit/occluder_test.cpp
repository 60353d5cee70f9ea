// Bodies that end rays, and the files that hold them.
#include "trace/occluder.h"

#include "fuzz/samples.h"
#include "unit/test_folder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strandlab {
namespace {

using testing_tools::contains;
using testing_tools::message_of;

std::vector<Triangle> read_text(const std::string& text) {
    return load_obj(ByteSource::from_memory("body.obj", samples::as_bytes(text)));
}

const std::string square =
    "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\ns off\nf 1//1 2//1 3//1 -1\n";

TEST(Occluder, ReadsFansOfTriangles) {
    const std::vector<Triangle> triangles = read_text(square);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[1][2], glm::vec3(0, 1, 0));
    EXPECT_GT(load_obj(ByteSource::from_file(STRANDLAB_MODELS "/head.obj")).size(), 1000u);
}

TEST(Occluder, RefusesDamagedFilesInOneLine) {
    const std::pair<std::string, const char*> damages[] = {
        {"", "no face in it"},
        {"v 0 0\n", "line 1: a vertex needs three numbers"},
        {"v 0 0 nan\n", "line 1: 'nan' is not a number"},
        {"v 0 0 1e30\n", "line 1: '1e30'"},
        {"v 0 0 0\nf 1 1\n", "line 2: a face needs three vertices"},
        {"v 0 0 0\nf 1 1 2\n", "line 2: '2' is no vertex: there are 1 so far"},
        {"v 0 0 0\nf 1 1 0\n", "'0' is no vertex"},
        {"v 0 0 0\nf 1 1 -2\n", "'-2' is no vertex"},
        {"v 0 0 0\nf 1 1 1.5\n", "'1.5' is no vertex"},
        {"v 0 0 0\nf 1 1 /2\n", "'/2' is no vertex"},
    };
    for (const auto& damage : damages) EXPECT_MESSAGE(read_text(damage.first), damage.second);
}

TEST(Occluder, EndsRaysWhereTheyMeetIt) {
    const Occluder occluder(read_text(square));
    std::vector<Ray> rays{{{0.5f, 0.25f, 2}, 0, {0, 0, -1}, 1e30f},  {{0.5f, 0.25f, 2}, 0, {0, 0, -1}, 1.5f},
                          {{0.5f, 0.25f, 2}, 2.5f, {0, 0, -1}, 9},   {{1.5f, 0.25f, 2}, 0, {0, 0, -1}, 1e30f},
                          {{0.5f, 0.5f, -3}, 0, {0, 0, 2}, 1e30f},   {{0.5f, 0.25f, 2}, 0, {0, 0, 0}, 1e30f},
                          {{0.5f, 0.25f, 2}, 0, {0, NAN, -1}, 1e30f}};
    const std::vector<Ray> before = rays;
    occluder.cut(rays);
    EXPECT_EQ(rays[0].tmax, 2);
    EXPECT_EQ(rays[4].tmax, 1.5f);
    for (const size_t untouched : {1, 2, 3, 5, 6}) EXPECT_EQ(rays[untouched].tmax, before[untouched].tmax);
    EXPECT_EQ(occluder.meet(before[0])->normal, glm::dvec3(0, 0, 1));
    EXPECT_EQ(occluder.meet(before[4])->normal, glm::dvec3(0, 0, -1));
    EXPECT_FALSE(Occluder({}).meet(before[0]));
}

}  // namespace
}  // namespace strandlab
