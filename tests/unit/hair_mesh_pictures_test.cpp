// The bundled hairstyles look as they did when they were looked at: small pictures, compared by FLIP.
#include "measure/bench_case.h"
#include "measure/flip.h"
#include "report/shading.h"
#include "trace/occluder.h"
#include "trace/ray_sets.h"
#include "unit/hair_mesh_models.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace strandlab {
namespace {

using testing_tools::hair_mesh_names;

constexpr uint32_t width = 72, height = 90, samples = 6;
constexpr double most_flip =
    0.02;  // compilers may round normals differently; another style differs by much more

/// Pixels of a picture, linear colours.
using Pixels = std::vector<glm::vec3>;

std::string path_of(const std::string& name) {
    return fmt::format(STRANDLAB_MODELS "/../tests/figures/hairstyles/{}.ppm", name);
}

/// The hair alone: rays end at the head, which is not drawn.
Pixels picture_of(const std::string& name, const std::string& changes = "") {
    const bool is_fur = name == "fur";
    Scene scene = load_scene(fmt::format(STRANDLAB_MODELS "/{}.hairmesh,strands={},points={},thickness=6{}",
                                         name, is_fur ? 12000 : 3000, is_fur ? 5 : 33, changes),
                             {});
    if (name != "braid") scene.occluder = load_obj(ByteSource::from_file(STRANDLAB_MODELS "/head.obj"));
    const Curves curves = all_curves(scene);
    CameraChoice from;
    from.from = {1, 0.3, 1.1};
    const Camera camera = framing(curves, double(width) / height, from);
    Rays rays = primary_rays(camera, {width, height, samples}, 1);
    Occluder(scene.occluder).cut(rays.rays);
    DeviceOptions cpu;
    cpu.selector = "cpu-float";
    const TraceDevice device(cpu);
    CaseInput input{device, scene, curves, 1, 0, {}};
    input.options.normals = true;
    const Hits hits = prepare_case(input, parse_primitive("rocaps")).traced->trace(rays, {}).hits;
    ShadingOptions shading;
    shading.width = width;
    shading.height = height;
    shading.samples = samples;
    shading.to_light = light_direction(camera);
    const Image image = shade(rays, hits, curves, shading);
    const Layer& layer = *image.with_channel("R");
    const std::vector<float>& colours = layer.floats();
    const size_t step = layer.channels.size();
    Pixels pixels(size_t(width) * height);
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = {colours[step * i], colours[step * i + 1], colours[step * i + 2]};
    return pixels;
}

float linear(uint8_t srgb) {
    const float x = static_cast<float>(srgb) / 255.0f;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

void write_picture(const std::string& path, const Pixels& pixels) {
    std::ofstream file(path, std::ios::binary);
    file << fmt::format("P6\n{} {}\n255\n", width, height);
    for (const glm::vec3& p : pixels)
        for (int c = 0; c < 3; ++c) file.put(static_cast<char>(to_srgb(p[c])));
    ASSERT_TRUE(file.good()) << path;
}

Pixels read_picture(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string type;
    uint32_t w = 0, h = 0, most = 0;
    file >> type >> w >> h >> most;
    file.get();
    Pixels pixels(size_t(width) * height);
    EXPECT_TRUE(file && type == "P6" && w == width && h == height && most == 255) << path;
    for (glm::vec3& p : pixels)
        for (int c = 0; c < 3; ++c) p[c] = linear(static_cast<uint8_t>(file.get()));
    EXPECT_TRUE(file.good()) << path;
    return pixels;
}

/// STRANDLAB_UPDATE_PICTURES=1 writes them anew: look at them before they are committed.
TEST(HairMeshPictures, LookAsTheyDid) {
    std::vector<Pixels> golden;
    for (const char* name : hair_mesh_names) {
        const Pixels now = picture_of(name);
        if (std::getenv("STRANDLAB_UPDATE_PICTURES") != nullptr) write_picture(path_of(name), now);
        golden.push_back(read_picture(path_of(name)));
        const double difference = mean_flip(golden.back(), now, width, height);
        fmt::print("{}: FLIP {:.4f}\n", name, difference);
        EXPECT_LE(difference, most_flip) << name;
    }
    // The measure tells styles apart, and a style from itself without its curls or with half its hair.
    for (size_t i = 1; i < golden.size(); ++i)
        EXPECT_GT(mean_flip(golden[i - 1], golden[i], width, height), 3 * most_flip) << hair_mesh_names[i];
    EXPECT_GT(mean_flip(golden[2], picture_of("ringlets", ",curl=0"), width, height), 2 * most_flip);
    EXPECT_GT(mean_flip(golden[0], picture_of("bob", ",strands=800"), width, height), 2 * most_flip);
}

}  // namespace
}  // namespace strandlab
