#include "commands/hit_files.h"

#include "base/error.h"
#include "base/log.h"
#include "base/npy.h"
#include "trace/ray_sets.h"

#include <cmath>
#include <filesystem>

namespace strandlab {
namespace {

const NpyItem one_float{"<f4", {}}, one_int{"<i4", {}}, three_floats{"<f4", {3}};

template <class Item>
std::vector<Item> read_column(const std::string& path, const NpyItem& item, size_t rays) {
    std::vector<Item> values = read_npy<Item>(ByteSource::from_file(path), item);
    if (values.size() != rays)
        fail(ExitCode::bad_input, "{}: holds {} items, but there are {} rays", path, values.size(), rays);
    return values;
}

void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(ExitCode::bad_input, "{}: cannot make the folder: {}", folder, error.message());
}

}  // namespace

Rays load_ray_file(const std::string& path) {
    LoadedRays loaded = load_rays(path);
    if (loaded.invalid > 0)
        warn("{}: {} rays with non-finite numbers, no direction, tmin < 0 or tmin > tmax count as misses",
             path, loaded.invalid);
    return std::move(loaded.rays);
}

void write_rays(const std::string& folder, const std::string& name, const Rays& rays) {
    make_folder(folder);
    write_npy((std::filesystem::path(folder) / (name + ".npy")).string(), {"<f4", {8}},
              std::span<const Ray>(rays.rays));
}

void write_hits(const std::string& folder, const Hits& hits) {
    make_folder(folder);
    const size_t count = hits.hits.size();
    std::vector<float> t(count), u(count);
    std::vector<int32_t> curve(count);
    for (size_t i = 0; i < count; ++i) {
        t[i] = hits.hits[i].t;
        u[i] = hits.hits[i].u;
        curve[i] = hits.hits[i].is_hit() ? static_cast<int32_t>(hits.hits[i].curve) : -1;
    }
    const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    write_npy(file("t.npy"), one_float, std::span<const float>(t));
    write_npy(file("curve.npy"), one_int, std::span<const int32_t>(curve));
    write_npy(file("u.npy"), one_float, std::span<const float>(u));
    if (!hits.normals.empty())
        write_npy(file("normal.npy"), three_floats, std::span<const glm::vec3>(hits.normals));
}

Hits read_hits(const std::string& folder, size_t rays) {
    const auto file = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    const std::vector<float> t = read_column<float>(file("t.npy"), one_float, rays);
    const std::vector<int32_t> curve = read_column<int32_t>(file("curve.npy"), one_int, rays);
    std::vector<float> u;
    if (std::filesystem::exists(file("u.npy"))) u = read_column<float>(file("u.npy"), one_float, rays);
    Hits hits;
    if (std::filesystem::exists(file("normal.npy")))
        hits.normals = read_column<glm::vec3>(file("normal.npy"), three_floats, rays);
    hits.hits.resize(rays);
    for (size_t i = 0; i < rays; ++i) {
        const bool miss = std::isinf(t[i]) && t[i] > 0;
        if (miss != (curve[i] < 0))
            fail(ExitCode::bad_input, "{}: ray {} has t = {} but curve {}: a miss is t = +inf and curve -1",
                 folder, i, t[i], curve[i]);
        if (!miss) hits.hits[i] = {t[i], u.empty() ? 0.0f : u[i], static_cast<uint32_t>(curve[i]), 0};
    }
    return hits;
}

}  // namespace strandlab
