#include "commands/ray_arguments.h"

#include "base/error.h"
#include "base/text.h"
#include "commands/arguments.h"
#include "commands/hit_files.h"
#include "commands/usage_error.h"
#include "trace/occluder.h"

#include <algorithm>
#include <optional>

namespace strandlab {
namespace {

bool is_file(const std::string& name) { return name.size() > 4 && name.substr(name.size() - 4) == ".npy"; }

std::string set_help() {
    std::string text = "ray set, repeatable, or FILE.npy (float32 [M,8]):";
    for (const RaySetInfo& set : ray_sets()) text += fmt::format(" {} ({});", set.name, set.help);
    text.pop_back();
    return text;
}

}  // namespace

void RayArguments::add_to(CLI::App& app, const std::string& default_names) {
    app.add_option("--rays", names, set_help())->allow_extra_args(false)->default_str(default_names);
    app.add_option("--resolution", resolution,
                   "WIDTHxHEIGHT (default: 640x360 on a CPU device, 1920x1080 on a GPU)");
    app.add_option(
        "--camera", camera,
        "eye=x,y,z:target=x,y,z[:up=x,y,z][:fov=degrees] or from=x,y,z[:zoom=factor]: then it fits the hair");
    app.add_option("--seed", seed, "of every ray set")
        ->capture_default_str()
        ->check(whole_number(0, ~uint64_t(0)));
    app.add_flag("--shuffle", shuffle, "rays in random order (incoherent)");
    app.add_option("--error-rays", error_rays, "rays of each set whose errors are measured (0: none)")
        ->capture_default_str()
        ->check(whole_number(0, 0xFFFFFFFF));
}

void RayArguments::check() const {
    parse_camera(camera);
    for (const std::string& name : names)
        if (!is_file(name)) ray_set_named(name);
}

Camera camera_of(const Scene& scene, const RayArguments& arguments, const Resolution& size) {
    const std::vector<glm::vec4> points = world_points(scene);
    return framing(points, double(size.width) / size.height, parse_camera(arguments.camera));
}

RaySets::RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments,
                 const Resolution& size, Caps caps) {
    const std::vector<Surface> common = common_surfaces(scene, caps);
    const bool needs_camera = std::any_of(arguments.names.begin(), arguments.names.end(),
                                          [](const std::string& name) { return !is_file(name); });
    // The light stands over the camera's right shoulder.
    const Camera camera = needs_camera ? camera_of(scene, arguments, size) : Camera{};
    const PictureSize picture{size.width, size.height, 1};
    std::optional<Occluder> occluder;
    if (!scene.occluder.empty()) occluder.emplace(scene.occluder);
    const auto cut = [&](Rays& rays) {
        if (occluder) occluder->cut(rays.rays);
    };
    Rays primary;
    Reference primary_reference;
    for (const std::string& name : arguments.names) {
        MeasuredRays set;
        if (is_file(name)) {
            set.rays = load_ray_file(name);
            // Rays of a picture of that size: its shape is the launch's.
            if (set.rays.rays.size() == size_t(size.width) * size.height) {
                set.rays.width = size.width;
                set.rays.height = size.height;
            }
        } else {
            const RaySetInfo& info = ray_set_named(name);
            if (info.needs_primary_hits && primary.rays.empty()) {
                primary = primary_rays(camera, picture, arguments.seed);
                cut(primary);
                primary_reference = make_scene_reference(scene, common, curves, primary.rays);
            }
            set.rays = make_rays(info, {curves,
                                        camera,
                                        picture,
                                        world_direction(camera, glm::normalize(glm::dvec3(0.5, 0.8, 0.7))),
                                        arguments.seed,
                                        arguments.shuffle,
                                        {primary.rays, primary_reference.hits}});
            set.shadow = info.name == "shadow";
        }
        cut(set.rays);
        set.sample = error_sample(set.rays.rays.size(), arguments.error_rays);
        set.sample_rays = selected(set.rays, set.sample);
        set.common = make_scene_reference(scene, common, curves, set.sample_rays);
        sets_.push_back(std::move(set));
    }
}

float RaySets::extent() const {
    float extent = 0;
    for (const MeasuredRays& set : sets_) extent = std::max(extent, extent_of(set.rays));
    return extent;
}

}  // namespace strandlab
