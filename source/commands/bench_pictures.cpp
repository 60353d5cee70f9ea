// What a run of bench measures on pictures and writes as such (--images).
#include "base/log.h"
#include "commands/bench_block.h"
#include "report/case_images.h"
#include "trace/scene_reference.h"

#include <filesystem>
#include <optional>

namespace strandlab {
namespace {

/// The path as a row holds it: from the folder of the rows' file, so that both can be moved together.
std::string path_in_row(const std::string& path, const std::string& json) {
    namespace fs = std::filesystem;
    const fs::path folder = json.empty() ? fs::current_path() : fs::absolute(json).parent_path();
    return fs::absolute(path).lexically_proximate(folder).string();
}

}  // namespace

void BenchRun::measure_distances(Block& block) const {
    if (options_.images.empty()) return;
    // From elsewhere other strands are within reach, but the same ones too small.
    CaseInput input = block.input;
    std::optional<CulledScene> culled;
    if (culling_.detail > 0) {
        culled = cull(block.scene, {.reach = false, .detail = culling_.detail}, {});
        input.culled = &*culled;
    }
    std::optional<DistantPictures> pictures;
    for (const Case& one : block.open) {
        if (one.primitive == choices_.size() || !block.rays.sets()[one.set].is_picture) continue;
        if (is_over_budget()) return;
        if (!pictures) {
            const Resolution& size = resolutions_[block.resolution];
            pictures.emplace(input, camera_of(block.scene, options_.rays, size), size.width, size.height,
                             options_.rays.seed, caps_);
        }
        try {
            block.distances[one.primitive] = pictures->errors_of(choices_[one.primitive]);
        } catch (const OutOfMemory&) {
            warn("{}: {} does not fit the device, no pictures from farther away", block.scene.name,
                 choices_[one.primitive].label());
        }
    }
}

std::string BenchRun::file_stem(const Block& block, const char* separator) const {
    const std::string& model = model_files_[block.model];
    return resolutions_.size() > 1 ? model + separator + axes_->resolutions[block.resolution] : model;
}

CaseFiles BenchRun::write_pictures(Block& block, const PreparedCase& prepared, const MeasuredRays& rays,
                                   const Hits& hits) const {
    if (block.picture_reference.empty())
        block.picture_reference =
            make_scene_hits(block.scene, common_surfaces(block.scene, caps_), rays.rays.rays);
    std::vector<glm::mat4x3> transforms;
    if (!block.scene.is_plain())
        for (const SceneInstance& instance : block.scene.instances)
            transforms.push_back(instance.world_from_object);
    const Resolution& size = resolutions_[block.resolution];
    const CaseImages files =
        write_case_images({.folder = options_.images,
                           .scene = file_stem(block, "_"),
                           .label = primitive_files_[index_of(choices_, prepared.choice)],
                           .width = size.width,
                           .height = size.height,
                           .rays = rays.rays,
                           .hits = hits,
                           .curves = block.curves,
                           .reference = block.picture_reference,
                           .to_light = light_direction(camera_of(block.scene, options_.rays, size)),
                           .world_from_object = transforms});
    const auto in_row = [&](const std::string& path) {
        return path.empty() ? "" : path_in_row(path, options_.json);
    };
    return {in_row(files.rendered), in_row(files.reference), in_row(files.error_map)};
}

}  // namespace strandlab
