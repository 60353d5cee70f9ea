// Options for ray sets, and the sets of a scene that they ask for.
#pragma once

#include "commands/arguments.h"
#include "measure/bench_case.h"
#include "trace/camera.h"
#include "trace/ray_sets.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace strandlab {

/// Which rays.
struct RayArguments {
    std::vector<std::string> names;  // ray sets or .npy files; behind one ":shuffled", ":shadow"
    std::string resolution;          // empty: by device
    std::string camera;
    uint64_t seed = 1;
    bool shuffle = false;
    size_t error_rays = 10'000;  // of each set; 0: no errors are measured

    void add_to(CLI::App& app, const std::string& default_names);
    /// Throws Error (usage) for a camera or a set that there is not: before work has begun on the others.
    void check() const;
    /// What the sets are called in results: "diffuse", "primary shuffled", "rays.npy".
    std::vector<std::string> set_names() const;
};

/// The camera that frames a scene as the options say.
Camera camera_of(const Scene& scene, const RayArguments& arguments, const Resolution& size);

/// The ray sets of a scene with the common reference's hits at their samples. Shadow, diffuse and ambient
/// rays spawn once from the reference's primary hits, and are the same for every primitive.
class RaySets {
  public:
    RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments, const Resolution& size,
            Caps caps);
    /// Only those of the names whose entry in `wanted` is set; the others stay empty.
    RaySets(const Scene& scene, const Curves& curves, const RayArguments& arguments, const Resolution& size,
            Caps caps, const std::vector<bool>& wanted);

    const std::vector<MeasuredRays>& sets() const { return sets_; }
    /// Largest coordinate of any origin.
    float extent() const;

  private:
    class Maker;

    std::vector<MeasuredRays> sets_;  // of each name
};

}  // namespace strandlab
