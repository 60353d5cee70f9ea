// Scene files (.json). They may name one model, which is there.
#include "fuzz/file_targets.h"
#include "fuzz/load_bytes.h"
#include "fuzz/refusal.h"
#include "fuzz/samples.h"
#include "fuzz/scratch_folder.h"
#include "scene/scene.h"

namespace strandlab::fuzz {
namespace {

void run(Bytes input) {
    const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
    // Files elsewhere and models of any size are not this target's.
    if (text.find("generate:") != std::string_view::npos || text.find('/') != std::string_view::npos ||
        text.find('\\') != std::string_view::npos)
        return;
    static const std::string model =
        scratch_folder().write("a.hair", samples::as_bytes(samples::hair(5, {3, 1})));
    const std::string path = scratch_folder().write("scene.json", input);
    Scene scene;
    if (!accepts([&] { scene = load_scene(path, {}); })) return;
    require(!scene.models.empty() && !scene.instances.empty(), "an empty scene");
    for (const Curves& curves : scene.models) require_invariants(curves);
    for (const SceneInstance& instance : scene.instances)
        require(instance.model < scene.models.size(), "an instance of no model");
    all_curves(scene);
    world_points(scene);
    object_extent(scene, 1.0f);
}

std::vector<std::string> seeds() {
    return {
        R"({"models": [{"file": "a.hair"}]})",
        R"({"models": [{"file": "a.hair", "radius": 4e-5, "radius_tip": 1e-5, "unit_scale": 0.01}, {"file": "a.hair"}],
 "instances": [{"model": 0}, {"model": 1, "transform": [1, 0, 0, 0.1, 0, 2, 0, 0, 0, 0, -1, 3]}]})",
        R"({"models": [{"file": "missing.npy", "strands": "missing.npy"}], "instances": []})",
    };
}

}  // namespace

FuzzTarget scene_target() { return {"scene", run, seeds}; }

}  // namespace strandlab::fuzz
