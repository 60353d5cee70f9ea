// Rays and hits as .npy files.
#include "commands/hit_files.h"
#include "fuzz/file_targets.h"
#include "fuzz/input_reader.h"
#include "fuzz/refusal.h"
#include "fuzz/samples.h"
#include "fuzz/scratch_folder.h"
#include "trace/ray_sets.h"

#include <cmath>

namespace strandlab::fuzz {
namespace {

void run_rays(Bytes input) {
    const std::string path = scratch_folder().write("rays.npy", input);
    LoadedRays loaded;
    if (!accepts([&] { loaded = load_rays(path); })) return;
    for (const Ray& ray : loaded.rays.rays) require(is_valid(ray), "an invalid ray was let through");
    require(std::isfinite(extent_of(loaded.rays)), "the extent of valid rays is not finite");
}

/// The files of one folder after each other, each preceded by the number of its bytes; 0: no such file.
void run_hits(Bytes input) {
    InputReader reader(input);
    const size_t rays = reader.below(8);
    for (const char* name : {"t.npy", "curve.npy", "u.npy", "normal.npy"}) {
        const size_t bytes = reader.take<uint16_t>();
        std::filesystem::remove(scratch_folder().path() / name);
        if (bytes > 0) scratch_folder().write(name, reader.part(bytes));
    }
    Hits hits;
    if (!accepts([&] { hits = read_hits(scratch_folder().path().string(), rays); })) return;
    require(hits.hits.size() == rays, "another number of hits");
    require(hits.normals.empty() || hits.normals.size() == rays, "another number of normals");
    for (const Hit& hit : hits.hits)
        require(hit.is_hit() || (std::isinf(hit.t) && hit.t > 0), "a miss at a distance");
}

std::string array(std::string_view type, std::string_view shape, std::span<const float> values) {
    std::string contents;
    for (const float value : values)
        if (type == "<f4")
            samples::put(contents, value);
        else
            samples::put(contents, static_cast<int32_t>(value));
    std::string dictionary = "{'descr': '";
    dictionary.append(type).append("', 'fortran_order': False, 'shape': ").append(shape).append(", }");
    return samples::npy(dictionary, contents);
}

std::vector<std::string> ray_seeds() {
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> rays{0, 0, 0, 0, 0, 0, 1, inf, 1, 2, 3, 0.5f, 0, -1, 0, 10};
    return {array("<f4", "(2, 8)", rays), array("<f4", "(1, 8)", std::span(rays).subspan(8))};
}

std::vector<std::string> hit_seeds() {
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> t{1.5f, inf}, curve{3, -1}, u{0.25f, 0}, normal{0, 0, 1, 0, 0, 0};
    std::vector<std::string> all;
    for (const bool full : {true, false}) {
        std::string bytes;
        samples::put(bytes, uint8_t(2));
        for (const std::string& file :
             {array("<f4", "(2,)", t), array("<i4", "(2,)", curve),
              full ? array("<f4", "(2,)", u) : std::string(), full ? array("<f4", "(2, 3)", normal) : ""}) {
            samples::put(bytes, static_cast<uint16_t>(file.size()));
            bytes += file;
        }
        all.push_back(bytes);
    }
    return all;
}

}  // namespace

FuzzTarget rays_target() { return {"rays", run_rays, ray_seeds}; }
FuzzTarget hits_target() { return {"hits", run_hits, hit_seeds}; }

}  // namespace strandlab::fuzz
