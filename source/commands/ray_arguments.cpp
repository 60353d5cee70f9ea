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

/// One --rays argument, taken apart.
struct RayName {
    std::string name;  // of a set or file
    bool is_file = false, shuffled = false, as_shadow = false;

    RayName(const std::string& text, bool shuffle_all) : name(text), shuffled(shuffle_all) {
        while (take(":shuffled", shuffled) || take(":shadow", as_shadow)) {
        }
        is_file = name.size() > 4 && name.ends_with(".npy");
    }

    /// What it asks for beyond its rays, as results name it: " shuffled shadow".
    std::string suffix() const {
        return std::string(shuffled ? " shuffled" : "") + (as_shadow ? " shadow" : "");
    }

  private:
    bool take(std::string_view suffix, bool& asked) {
        if (!name.ends_with(suffix)) return false;
        name.resize(name.size() - suffix.size());
        asked = true;
        return true;
    }
};

std::string set_help() {
    std::string text =
        "ray set, repeatable, or FILE.npy (float32 [M,8]); NAME:shuffled is in random order, "
        "NAME:shadow traced up to any hit;";
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
    set_names();
}

std::vector<std::string> RayArguments::set_names() const {
    std::vector<std::string> all;
    for (const std::string& text : names) {
        const RayName ray(text, shuffle);
        all.push_back((ray.is_file ? ray.name : std::string(ray_set_named(ray.name).name)) + ray.suffix());
    }
    return all;
}

Camera camera_of(const Scene& scene, const RayArguments& arguments, const Resolution& size) {
    const std::vector<glm::vec4> points = world_points(scene);
    return framing(points, double(size.width) / size.height, parse_camera(arguments.camera));
}

/// Makes sets one after another; what they share is made once, when the first needs it.
class RaySets::Maker {
  public:
    Maker(const Scene& scene, const Curves& curves, const RayArguments& arguments, const Resolution& size,
          Caps caps)
        : scene_(scene),
          curves_(curves),
          arguments_(arguments),
          size_{size.width, size.height, 1},
          caps_(caps) {
        if (!scene.occluder.empty()) occluder_.emplace(scene.occluder);
    }

    MeasuredRays make(const std::string& text) {
        const RayName name(text, arguments_.shuffle);
        MeasuredRays set = name.is_file ? from_file(name) : from_table(name);
        set.shuffled = name.shuffled;
        set.as_shadow = name.as_shadow;
        if (name.as_shadow) {
            set.shadow = true;
            set.is_picture = false;
            set.rays.name += " shadow";
        }
        cut(set.rays);
        set.sample = error_sample(set.rays.rays.size(), arguments_.error_rays);
        set.sample_rays = selected(set.rays, set.sample);
        // Surfaces of large scenes take long: none for no rays.
        if (!set.sample.empty())
            set.common = make_scene_reference(scene_, common(), curves_, set.sample_rays);
        return set;
    }

  private:
    MeasuredRays from_file(const RayName& name) const {
        MeasuredRays set;
        set.kind = "file";
        set.rays = load_ray_file(name.name);
        // Rays of a picture of that size: its shape is the launch's.
        if (set.rays.rays.size() == size_.rays()) {
            set.rays.width = size_.width;
            set.rays.height = size_.height;
        }
        if (name.shuffled) {
            shuffle(set.rays, arguments_.seed);
            set.rays.name += " shuffled";
        }
        return set;
    }

    MeasuredRays from_table(const RayName& name) {
        const RaySetInfo& info = ray_set_named(name.name);
        if (!camera_) camera_ = camera_of(scene_, arguments_, {size_.width, size_.height});
        if (info.needs_primary_hits && primary_.rays.empty()) {
            primary_ = primary_rays(*camera_, size_, arguments_.seed);
            cut(primary_);
            primary_hits_ = make_scene_hits(scene_, common(), primary_.rays);
        }
        MeasuredRays set;
        set.rays = make_rays(info, {curves_,
                                    *camera_,
                                    size_,
                                    light_direction(*camera_),
                                    arguments_.seed,
                                    name.shuffled,
                                    {primary_.rays, primary_hits_}});
        set.kind = info.name;
        set.shadow = info.hit_or_miss_only;
        set.is_picture = info.name == "primary" && !name.shuffled;
        if (info.name == "primary" || info.needs_primary_hits) set.camera = to_string(*camera_);
        return set;
    }

    std::span<const Surface> common() {
        if (common_.empty()) common_ = common_surfaces(scene_, caps_);
        return common_;
    }

    /// The body under the hair ends rays, the same for every primitive.
    void cut(Rays& rays) const {
        if (occluder_) occluder_->cut(rays.rays);
    }

    const Scene& scene_;
    const Curves& curves_;
    const RayArguments& arguments_;
    PictureSize size_;
    Caps caps_;
    std::vector<Surface> common_;  // made when something is first measured against it
    std::optional<Occluder> occluder_;
    std::optional<Camera> camera_;
    Rays primary_;
    std::vector<ReferenceHit> primary_hits_;
};

RaySets::RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments,
                 const Resolution& size, Caps caps)
    : RaySets(scene, curves, arguments, size, caps, std::vector<bool>(arguments.names.size(), true)) {}

RaySets::RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments,
                 const Resolution& size, Caps caps, const std::vector<bool>& wanted)
    : sets_(arguments.names.size()) {
    Maker maker(scene, curves, arguments, size, caps);
    for (size_t i = 0; i < sets_.size(); ++i)
        if (wanted[i]) sets_[i] = maker.make(arguments.names[i]);
}

float RaySets::extent() const {
    float extent = 0;
    for (const MeasuredRays& set : sets_) extent = std::max(extent, extent_of(set.rays));
    return extent;
}

}  // namespace strandlab
